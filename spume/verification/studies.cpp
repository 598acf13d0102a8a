#include "spume/base/error.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

const std::vector<Study>& studies() {
  const char* const geometry = "closed-form geometry, Young-Laplace";
  const char* const linearised = "the linearised thin-film equation (docs/exact_drainage.md)";
  const char* const derived = "closed form (docs/exact_drainage.md)";
  static const std::vector<Study> all{
      {"vertical-film", "a vertical film thins by its weight", derived, 1, 1, vertical_film},
      {"border-hydrostatic", "a vertical border at rest", derived, 1, 1, border_hydrostatic},
      {"film-modes-flat", "decay of small modes on a flat film", linearised, 2, 1, film_modes_flat},
      {"border-front", "a wetting front runs down a border", derived, 4, 2, border_front},
      {"film-rim", "a flat film thins along its border", "one-dimensional finite volumes", 5, 1, film_rim},
      {"border-table3", "drainage of four Plateau borders with a known solution", "the paper's Table 3", 5, 1,
       border_table3},
      {"border-table4", "drainage of four Plateau borders under gravity", "the paper's Table 4", 5, 1,
       border_table4},
      {"film-modes-sphere", "decay of small modes on a sphere", linearised, 8, 1, film_modes_sphere},
      {"spherical-film", "top and bottom of a spherical film by its weight", derived, 8, 1, spherical_film},
      {"film-modes-cylinder", "decay and growth of small modes on a tube", linearised, 10, 1,
       film_modes_cylinder},
      {"taylor-green", "order of the gas flow on carried vortices", "closed-form flows", 15, 2, taylor_green},
      {"film-corner", "a film thins in the corner between two borders", "a radially graded corner", 20, 5,
       film_corner},
      {"reconstruction-damping", "an oscillating bubble, reconstructed often and rarely",
       "reconstruction takes no energy", 20, 20, reconstruction_damping},
      {"reconstruction", "the exact tetrahedral cluster, reconstructed 1 and 20 times without flow",
       "closed-form geometry, Plateau's laws", 40, 5, reconstruction},
      {"double-bubble", "two equal spheres to rest by gas dynamics", geometry, 50, 10, double_bubble},
      {"unequal-double-bubble", "two spheres of volumes 1:2 to rest by gas dynamics", geometry, 50, 10,
       unequal_double_bubble},
      {"fig15-drainage", "the exact four-bubble cluster drains for 16.1 s on four meshes",
       "the paper's Fig. 15; hydrostatics", 60, 5, fig15_drainage},
      {"triple-bubble", "three equal spheres to rest by gas dynamics", geometry, 60, 10, triple_bubble},
      {"tetrahedral-cluster", "four equal spheres to rest by gas dynamics", geometry, 60, 10,
       tetrahedral_cluster},
      {"quasistatic", "clusters of two to 27 bubbles relaxed without gas",
       "closed-form geometry; an independent minimiser for five bubbles", 65, 10, quasistatic},
      {"crystals", "the foams of Kelvin and of Weaire and Phelan", "Surface Evolver", 65, 20, crystals},
      {"lamella-table2", "drainage of a catenoid under gravity", "the paper's Table 2", 70, 5,
       lamella_table2},
      {"drainage-cost", "time of the published and of the positive drainage at equal errors",
       "the paper's schemes", 110, 5, drainage_cost},
      {"liquid-transport",
       "liquid rides along with films: a bubble's mode, foams at rest, a cluster that moves",
       "exact linear flow; material points", 120, 27, liquid_transport},
      {"bubble-volumes", "volume of every bubble while twenty rearrange", "nothing is lost", 120, 40,
       bubble_volumes},
      {"lamella-table1", "drainage of a catenoid with a known solution", "the paper's Table 1; closed form",
       150, 15, lamella_table1},
      {"film-meshes", "meshes for drainage of 50 networks before and after ruptures",
       "the mesh of Sec. 3.3.1", 250, 25, film_meshes},
      {"oscillating-bubble", "frequency and damping of modes 2, 3, 4 of a bubble", "exact viscous law", 300,
       10, oscillating_bubble},
      {"static-currents", "spurious currents of exact clusters at rest",
       "a foam in equilibrium does not move", 300, 30, static_currents},
      {"fig12-area", "film area after a cluster loses a film", "the paper's Fig. 12; equilibrium without gas",
       300, 50, fig12_area},
      {"fig13-oscillation", "frequency of a bubble merged from two", "the paper's Fig. 13; exact viscous law",
       300, 40, fig13_oscillation},
      {"equilibrium-convergence", "order of equilibria over 32³, 48³, 64³, 96³", geometry, 400, 40,
       equilibrium_convergence},
      {"capillary-wave", "a wave on a film between equal fluids", "exact initial-value solution", 400, 15,
       capillary_wave},
      {"interface-methods", "the film mesh and the paper's interface method side by side",
       "closed-form geometry", 400, 60, interface_methods},
      {"robustness", "twenty random clusters merge film by film to one bubble",
       "conforming, whole, energy falls", 1500, 150, robustness},
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
