#pragma once

#include <functional>
#include <string>
#include <vector>

#include "spume/parallel/communicator.hpp"
#include "spume/verification/report.hpp"

namespace spume::verification {

/// How thoroughly to run.
enum class Scale {
  Full,   ///< the grids that the bands are meant for
  Small,  ///< fewer and coarser grids, wider bands; a quick look
};

/// A comparison with exact solutions or published numbers.
struct Study {
  std::string name;
  std::string summary;            ///< what is compared, in one line
  std::string source;             ///< of what it is compared with
  double seconds, small_seconds;  ///< about, on one core
  std::function<void(const parallel::Communicator&, Scale, Report&)> run;
};

/// All studies, the quicker ones first.
const std::vector<Study>& studies();

/// Runs one study into the report; a NumericalError inside is told as a failure of the study. Collective.
void run(const Study& study, const parallel::Communicator& communicator, Scale scale, Report& report);

}  // namespace spume::verification
