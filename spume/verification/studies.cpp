#include "spume/base/error.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

const std::vector<Study>& studies() {
  static const std::vector<Study> all{
      {"reconstruction", "the exact tetrahedral cluster, reconstructed 1 and 20 times without flow",
       "closed-form geometry, Plateau's laws", 60, 5, reconstruction},
      {"double-bubble", "two equal spheres to rest by gas dynamics", "closed-form geometry, Young-Laplace",
       90, 20, double_bubble},
      {"unequal-double-bubble", "two spheres of volumes 1:2 to rest by gas dynamics",
       "closed-form geometry, Young-Laplace", 90, 20, unequal_double_bubble},
      {"triple-bubble", "three equal spheres to rest by gas dynamics", "closed-form geometry, Young-Laplace",
       90, 20, triple_bubble},
      {"tetrahedral-cluster", "four equal spheres to rest by gas dynamics",
       "closed-form geometry, Young-Laplace", 90, 20, tetrahedral_cluster},
      {"quasistatic", "clusters of two to 27 bubbles relaxed without gas",
       "closed-form geometry; an independent minimiser for five bubbles", 120, 10, quasistatic},
      {"oscillating-bubble", "frequency and damping of modes 2, 3, 4 of a bubble", "exact viscous law", 300,
       10, oscillating_bubble},
      {"static-currents", "spurious currents of exact clusters at rest",
       "a foam in equilibrium does not move", 600, 60, static_currents},
  };
  return all;
}

void run(const Study& study, const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.begin(study.name, study.summary, scale == Scale::Full ? study.seconds : study.small_seconds);
  try {
    study.run(communicator, scale, report);
  } catch (const NumericalError& error) {
    report.failed(error.what());
  }
  report.end();
}

}  // namespace spume::verification
