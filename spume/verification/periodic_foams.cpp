#include <cmath>

#include "spume/mesh/measure.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

using simulation::LatticeShape;

struct Crystal {
  LatticeShape::Structure structure;
  int cubic_cells;
  const char* name;
  double area;   ///< A/(N V^(2/3)) of the relaxed foam
  double faces;  ///< of a bubble, in the mean
};
// Brakke's Surface Evolver, as given by Weaire and Phelan (1994) and Kusner and Sullivan (1996).
constexpr Crystal kelvin_foam{LatticeShape::Structure::Kelvin, 2, "Kelvin", 2.65314, 14};
constexpr Crystal weaire_phelan_foam{LatticeShape::Structure::WeairePhelan, 1, "Weaire and Phelan", 2.64417,
                                     13.5};

/// Film area a bubble over V^(2/3), relaxed without gas.
double relaxed_area(const parallel::Communicator& communicator, const Crystal& crystal, int cells,
                    Report& report) {
  const Units units = units_of_laplace_number(1e4);
  auto run_case = cube_case(units, cells, cells / 4.0);
  run_case.foam.lattice = LatticeShape{.structure = crystal.structure, .cells = crystal.cubic_cells};
  FoamRun run(communicator, run_case);
  run.equilibrate();
  const int n = run.foam().phases.n_bubbles();
  const double volume = std::pow(4 * units.radius, 3) / n;
  const auto& topology = run.topology();
  report.absolute(std::string(crystal.name) + ": faces a bubble", 2.0 * topology.n_lamellae() / n,
                  crystal.faces, 0, "structure");
  report.absolute(std::string(crystal.name) + ": edges that do not conform", topology.n_nonconforming_edges,
                  0, 0, "conforming mesh");
  return mesh::film_area(run.foam().films) / (n * std::pow(volume, 2.0 / 3));
}

}  // namespace

void crystals(const parallel::Communicator& communicator, Scale scale, Report& report) {
  const int cells = scale == Scale::Full ? 64 : 40;
  report.note("foams that fill a periodic box, relaxed without gas; " + std::to_string(cells) +
              " cells an edge");
  double area[2];
  int n = 0;
  for (const Crystal& crystal : {kelvin_foam, weaire_phelan_foam}) {
    area[n] = relaxed_area(communicator, crystal, cells, report);
    report.relative(std::string(crystal.name) + ": film area a bubble, V^(2/3)", area[n], crystal.area, 5e-4,
                    "Surface Evolver (Weaire and Phelan 1994)");
    ++n;
  }
  report.at_most("area of Weaire and Phelan's over that of Kelvin's", area[1] / area[0], 1, "0.99662");
}

}  // namespace spume::verification
