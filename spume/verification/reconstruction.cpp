#include <fmt/format.h>

#include <cmath>

#include "spume/verification/clusters.hpp"
#include "spume/verification/film_angles.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

struct Bands {
  double rms, length, area, centre;
};

void judge(FoamRun& run, int times, const Bands& bands, Report& report) {
  const double h = run.grid().h();
  const ClusterErrors errors = errors_of_cluster(run, 4);
  const PlateauAngles angles = plateau_angles(run.foam().films, run.topology(), 4 * h, h);
  const std::string after = fmt::format(" after {}", times);
  report.absolute("area error" + after, errors.area, 0, bands.area, "exact geometry");
  report.absolute("length error of inner borders" + after, errors.inner_border, 0, bands.length,
                  "exact geometry");
  report.told("length error of all borders" + after, errors.border_length, "exact geometry", 0);
  report.at_most("angles of films from 120°, rms" + after, angles.film_rms, bands.rms, "Plateau's laws");
  report.told("the same, largest", angles.film_largest, "Plateau's laws");
  report.told("angles of borders from 109.47°, rms" + after, angles.border_rms, "Plateau's laws");
  report.at_most("drift of the centre, h" + after, errors.centre / h, bands.centre, "symmetry");
}

}  // namespace

void reconstruction(const parallel::Communicator& communicator, Scale scale, Report& report) {
  const Units units = units_of_laplace_number(1e5);
  for (const int cells_per_radius : {8, 16}) {
    if (scale == Scale::Small && cells_per_radius > 8) break;
    report.note(fmt::format("tetrahedral cluster, R = {} h, reconstructed again and again without flow",
                            cells_per_radius));
    FoamRun run(communicator,
                with_cluster(cube_case(units, 4 * cells_per_radius + 8, cells_per_radius), units, 4));
    put_onto_exact_cluster(run, units.radius);
    const double h = run.grid().h();
    report.told("angles of the exact mesh from 120°, rms: the fits",
                plateau_angles(run.foam().films, run.topology(), 4 * h, h).film_rms, "Plateau's laws", 0);
    const double part = cells_per_radius == 8 ? 1 : 0.25;
    for (int times = 1; times <= 20; ++times) {
      run.reconstruct();
      if (times == 1) judge(run, times, {1.1, 5e-3 * part, 1.1e-3 * part, 0.04}, report);
      if (times == 20) judge(run, times, {1.4, 5e-3 * part, 1.1e-3 * part, 0.04}, report);
    }
  }
}

}  // namespace spume::verification
