#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/base/union_find.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

struct Cascade {
  int count, cells;
  double cells_per_radius, spread, laplace;
  std::uint64_t seed;
};

/// What went wrong, or right, on the way to one bubble.
struct Outcome {
  int merges = 0, bubbles_at_start = 0, bubbles_left = 0, reconstructions = 0;
  int n_nonconforming = 0;  ///< edges, summed over the meshes after reconstructions and merges
  int n_stray = 0;          ///< pieces of a phase beyond the first, summed likewise
  double energy_rise =
      0;  ///< largest of film and kinetic energy in a step without a topological change, over 2σA
  double energy_jump = -1;  ///< the same in steps with one
  long n_split = 0, n_absorbed = 0, n_lost = 0, n_pocket = 0;
  std::optional<std::string> failure;
};

/// The pair of phases, one a bubble at least, whose smallest lamella is the smallest of all.
std::optional<std::pair<mesh::Phase, mesh::Phase>> smallest_film(const mesh::FilmMesh& films,
                                                                 const mesh::Topology& topology) {
  const auto area = mesh::lamella_areas(films, topology);
  std::optional<std::pair<mesh::Phase, mesh::Phase>> pair;
  double least = 1e300;
  for (int l = 0; l < topology.n_lamellae(); ++l) {
    const auto& lamella = topology.lamella[l];
    if (lamella.phase_a == 0 || area[l] >= least) continue;
    least = area[l];
    pair = {lamella.phase_a, lamella.phase_b};
  }
  return pair;
}

/// Closed surfaces of the bubbles beyond one each: sides of lamellae that meet at a vertex are of one
/// surface. The outside has more than one where bubbles have come apart.
int count_stray_pieces(const mesh::Topology& topology) {
  UnionFind sides(2 * topology.n_lamellae());
  const auto side = [&](int lamella, mesh::Phase p) {
    return 2 * lamella + (topology.lamella[lamella].phase_b == p ? 1 : 0);
  };
  std::map<std::pair<int, mesh::Phase>, int> met;  // a side at this vertex with this bubble
  for (const auto& dof : topology.film_dof) {
    const auto& lamella = topology.lamella[dof.lamella];
    for (const mesh::Phase p : {lamella.phase_a, lamella.phase_b}) {
      const int here = side(dof.lamella, p);
      sides.join(here, met.try_emplace({dof.vertex, p}, here).first->second);
    }
  }
  std::set<mesh::Phase> bubbles;
  std::set<int> surfaces;
  for (int l = 0; l < topology.n_lamellae(); ++l)
    for (const mesh::Phase p : {topology.lamella[l].phase_a, topology.lamella[l].phase_b}) {
      if (p == 0) continue;
      bubbles.insert(p);
      surfaces.insert(sides.find(side(l, p)));
    }
  return static_cast<int>(surfaces.size() - bubbles.size());
}

/// A cluster merges film by film, one capillary time apart, until a single bubble is left.
Outcome run_cascade(const parallel::Communicator& communicator, const Cascade& cascade) {
  const Units units = units_of_laplace_number(cascade.laplace);
  auto run_case = cube_case(units, cascade.cells, cascade.cells_per_radius);
  run_case.foam.cluster = simulation::ClusterShape{.count = cascade.count,
                                                   .mean_diameter = 2 * units.radius,
                                                   .spread = cascade.spread,
                                                   .seed = cascade.seed,
                                                   .center = {}};
  Outcome outcome;
  const auto look_at = [&](const mesh::Topology& topology) {
    outcome.n_nonconforming += topology.n_nonconforming_edges;
    outcome.n_stray += count_stray_pieces(topology);
  };
  try {
    FoamRun run(communicator, run_case);
    outcome.bubbles_at_start = run.foam().phases.n_bubbles();
    double energy = units.tension * mesh::film_area(run.foam().films);
    const double scale = energy;
    for (int round = 1; run.foam().phases.n_bubbles() > 1; ++round) {
      run.move_until(round * units.time(), [&](const simulation::MotionStep& step) {
        const double now = units.tension * step.film_area + step.kinetic_energy;
        double& rise = step.events.empty() ? outcome.energy_rise : outcome.energy_jump;
        rise = std::max(rise, (now - energy) / scale);
        energy = now;
        outcome.reconstructions += step.reconstructed;
        if (step.reconstructed) look_at(run.topology());
        return run.foam().phases.n_bubbles() > 1;
      });
      if (run.foam().phases.n_bubbles() <= 1) break;
      const auto pair = smallest_film(run.foam().films, run.topology());
      if (!pair) break;  // the bubbles have come apart
      run.tear(pair->first, pair->second);
      ++outcome.merges;
      look_at(run.topology());
      energy = units.tension * mesh::film_area(run.foam().films) +
               flow::kinetic_energy(run.foam().gas, units.density);
    }
    outcome.bubbles_left = run.foam().phases.n_bubbles();
    const auto count = [&](const char* kind) {
      return std::ranges::count(run.events, kind, &state::Event::kind);
    };
    outcome.n_split = count("bubble split");
    outcome.n_absorbed = count("piece absorbed");
    outcome.n_lost = count("bubble lost");
    outcome.n_pocket = count("pocket");
  } catch (const NumericalError& error) {
    outcome.failure = error.what();
  }
  return outcome;
}

void judge(const Cascade& cascade, const Outcome& outcome, Report& report) {
  const std::string what =
      fmt::format("{} bubbles, R = {} h ± {:.0f} %, La = {:.0e}, seed {}: ", cascade.count,
                  cascade.cells_per_radius, 100 * cascade.spread, cascade.laplace, cascade.seed);
  if (outcome.failure) {
    report.failed(what + *outcome.failure);
    return;
  }
  report.note(
      fmt::format("{}{} merges, {} reconstructions; events: {} splits, {} absorbed, {} lost, {} pockets",
                  what, outcome.merges, outcome.reconstructions, outcome.n_split, outcome.n_absorbed,
                  outcome.n_lost, outcome.n_pocket));
  report.absolute("bubbles left", outcome.bubbles_left, 1, 0, "all films but one merge");
  const double told =
      outcome.bubbles_at_start - outcome.merges + outcome.n_split + outcome.n_pocket - outcome.n_lost;
  report.absolute("bubbles left by the events", told, outcome.bubbles_left, 0,
                  "every birth and death is told");
  report.at_most("non-conforming edges", outcome.n_nonconforming, 0, "conforming by construction");
  report.at_most("stray pieces of a phase in a mesh", outcome.n_stray, 0, "a bubble is one piece");
  report.at_most("rise of energy in a step, over 2σA", outcome.energy_rise, 1e-3, "energy falls");
  report.at_most("the same at topological changes", outcome.energy_jump, 1e-3, "energy falls");
}

}  // namespace

void robustness(const parallel::Communicator& communicator, Scale scale, Report& report) {
  report.note("random clusters merge film by film, one capillary time apart, to one bubble");
  constexpr int n_clusters = 20;
  // Radii from 2.5 h (5 h less two standard deviations) to 10 h (7 h and two of them).
  const int n = scale == Scale::Full ? n_clusters : 2;
  for (int i = 0; i < n; ++i) {
    Cascade cascade{.count = 12,
                    .cells = 48,
                    .cells_per_radius = i % 3 == 0 ? 6.0 : 5.0,
                    .spread = i % 3 == 0 ? 0.2 : 0.25,
                    .laplace = i % 2 == 0 ? 1e3 : 1e5,
                    .seed = static_cast<std::uint64_t>(i + 1)};
    if (i % 3 == 1) cascade.count = 20, cascade.cells_per_radius = 5, cascade.cells = 48;
    if (i % 5 == 4) cascade = {27, 64, 6, 0.25, cascade.laplace, cascade.seed};
    if (i % 5 == 3) cascade = {12, 64, 7.5, 0.2, cascade.laplace, cascade.seed};
    judge(cascade, run_cascade(communicator, cascade), report);
  }
}

}  // namespace spume::verification
