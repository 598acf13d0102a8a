#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "spume/verification/clusters.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

void equilibrium_convergence(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("four spheres too far apart by 5 % in the same box on finer and finer grids, gas until rest");
  const Units units = units_of_laplace_number(400);
  const std::vector<int> grids =
      scale == Scale::Full ? std::vector<int>{32, 48, 64, 96} : std::vector<int>{32, 48};
  std::vector<ClusterErrors> errors;
  for (const int cells : grids) {
    FoamRun run(communicator, with_cluster(cube_case(units, cells, 6.0 * cells / 32), units, 4, 1.05));
    run.move_until(12 * units.time());
    errors.push_back(errors_of_cluster(run, 4));
    report.told(fmt::format("{}³, R = {:.0f} h: film area, relative error", cells, 6.0 * cells / 32),
                errors.back().area, "exact geometry", 0);
    report.told("pressure, relative error", errors.back().pressure, "4σ/R", 0);
    report.told("border length, relative error", errors.back().border_length, "exact geometry", 0);
  }
  const auto order = [&](double ClusterErrors::*of) {
    return std::log(std::abs(errors.front().*of / (errors.back().*of))) /
           std::log(static_cast<double>(grids.back()) / grids.front());
  };
  report.absolute("order of the area, coarsest to finest", order(&ClusterErrors::area), 2, 0.4,
                  "second order");
  report.at_least("order of the border length, coarsest to finest", order(&ClusterErrors::border_length), 1.6,
                  "second order");
}

}  // namespace spume::verification
