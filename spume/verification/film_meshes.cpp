#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/base/stage_times.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/meshing/figures.hpp"
#include "spume/simulation/drainage_mesh.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

constexpr double cells_per_radius = 5;

/// How one network was meshed.
struct Meshing {
  meshing::MeshFigures figures;
  double film_distance, border_distance, drawn_together_distance, film_shift;  // [h]
  double volume_error;                                                         // of a bubble, relative
  bool same_foam;  // lamellae, borders and junctions are those from before
  int n_relaxation_steps;
  double seconds;                       // of processor time
  double contour_seconds, new_seconds;  // a contour alone; a contour with its vertices projected
};

/// One network, meshed uniformly and graded.
struct Network {
  std::string name;
  int bubbles, lamellae;
  Meshing uniform, graded;
};

/// Processor time that a reconstruction spent on a stage [s].
double seconds(const StageTimes& times, std::string_view stage) {
  double sum = 0;
  for (const auto& [name, s] : times.seconds())
    if (name == stage) sum += s;
  return sum;
}

double largest_volume_error(const mesh::FilmMesh& films, const state::Phases& phases) {
  const auto volume = mesh::phase_volumes(films, phases.count());
  double largest = 0;
  for (mesh::Phase p = 1; p < phases.count(); ++p)
    if (phases.alive(p)) largest = std::max(largest, std::abs(volume[p] / phases.target_volume[p] - 1));
  return largest;
}

/// The mesh as drainage gets it, of a foam with `edge_at_borders` [h].
Meshing mesh_films(const grid::Grid& grid, simulation::Case run_case, state::Foam foam,
                   double edge_at_borders) {
  const double h = grid.h();
  run_case.meshing.edge_at_borders = edge_at_borders * h;
  std::vector<state::Event> events;
  const auto mesh = simulation::mesh_for_drainage(grid, run_case, foam, events);
  const mesh::Topology& before = mesh.update.topology;
  const mesh::Topology after = mesh::build_topology(mesh.films);

  Meshing meshing{};
  meshing.figures = meshing::figures_of(mesh.films, after, mesh.project);
  meshing.film_distance = meshing.figures.film_distance / h;
  meshing.border_distance = meshing.figures.border_distance / h;
  meshing.drawn_together_distance = meshing.figures.drawn_together_distance / h;
  meshing.film_shift = mesh.largest_shift / h;
  meshing.volume_error = largest_volume_error(mesh.films, foam.phases);
  meshing.same_foam = after.n_lamellae() == before.n_lamellae() && after.n_borders() == before.n_borders() &&
                      after.n_junctions() == before.n_junctions();
  meshing.n_relaxation_steps = mesh.n_relaxation_steps;
  meshing.seconds = mesh.seconds;
  const auto& times = mesh.update.reconstruction.times;
  meshing.contour_seconds = seconds(times, "contour");
  meshing.new_seconds = meshing.contour_seconds + seconds(times, "projection");
  return meshing;
}

/// Makes the meshes for drainage of a foam as it is, leaving the foam alone.
Network mesh_network(FoamRun& run, const std::string& name) {
  constexpr double fine = 0.3;
  return {name, run.foam().phases.n_bubbles(), run.topology().n_lamellae(),
          mesh_films(run.grid(), run.run_case(), run.foam(), 1),
          mesh_films(run.grid(), run.run_case(), run.foam(), fine)};
}

/// Steps towards rest without gas, with reconstructions as they fall due.
void relax(FoamRun& run, int n_steps) {
  int n = 0;
  simulation::equilibrate(run.grid(), run.run_case(), run.foam(), run.events,
                          [&](const auto&, const auto&) { return ++n < n_steps; });
  run.forget_motion();
}

void tear_some_film(FoamRun& run, Random& random) {
  std::vector<std::pair<mesh::Phase, mesh::Phase>> pairs;
  for (const auto& lamella : run.topology().lamella)
    if (lamella.phase_a > 0) pairs.emplace_back(lamella.phase_a, lamella.phase_b);
  if (pairs.empty()) return;
  const auto n = std::min(pairs.size() - 1, static_cast<std::size_t>(random.uniform(0, 1) * pairs.size()));
  run.tear(pairs[n].first, pairs[n].second);
}

struct Sequence {
  int count, cells;
  double spread;
  std::uint64_t seed;
  int n_ruptures;  ///< each gives two networks: at once, and relaxed
  int torn_at_once = 1;
};

void run_sequence(const parallel::Communicator& communicator, const Sequence& s,
                  std::vector<Network>& networks) {
  const Units units = units_of_laplace_number(1e3);
  auto run_case = cube_case(units, s.cells, cells_per_radius);
  run_case.foam.cluster = simulation::ClusterShape{
      .count = s.count, .mean_diameter = 2 * units.radius, .spread = s.spread, .seed = s.seed, .center = {}};
  FoamRun run(communicator, run_case);
  Random random(s.seed);
  const std::string who = fmt::format("{} bubbles, seed {}", s.count, s.seed);
  relax(run, 10);
  networks.push_back(mesh_network(run, who + ", relaxed"));
  for (int r = 1; r <= s.n_ruptures; ++r) {
    for (int n = 0; n < s.torn_at_once; ++n) tear_some_film(run, random);
    networks.push_back(mesh_network(run, fmt::format("{}, rupture {}", who, r * s.torn_at_once)));
    relax(run, 10);
    networks.push_back(mesh_network(run, fmt::format("{}, rupture {}, relaxed", who, r * s.torn_at_once)));
  }
}

std::string line(const Meshing& m) {
  const auto& f = m.figures;
  auto text =
      fmt::format("{} triangles; angle {:.1f}, median {:.1f}; off by {:.4f}, {:.4f} h", f.n_triangles,
                  f.smallest_angle_degrees, f.median_angle_degrees, m.film_distance, m.border_distance);
  if (m.n_relaxation_steps > 0) text += fmt::format("; relaxed by {} steps", m.n_relaxation_steps);
  return text;
}

using Figure = std::function<double(const Meshing&)>;

double largest(const std::vector<Network>& networks, Meshing Network::*which, const Figure& figure) {
  double value = -1e300;
  for (const Network& n : networks) value = std::max(value, figure(n.*which));
  return value;
}

double total(const std::vector<Network>& networks, Meshing Network::*which, double Meshing::*what) {
  double sum = 0;
  for (const Network& n : networks) sum += n.*which.*what;
  return sum;
}

void judge(const std::vector<Network>& networks, Meshing Network::*which, Report& report) {
  const char* const source = "bar of this project; paper, Sec. 3.3.1: nearly equilateral";
  const auto most = [&](const Figure& figure) { return largest(networks, which, figure); };
  const auto least = [&](const Figure& figure) {
    return -most([&](const Meshing& m) { return -figure(m); });
  };
  report.at_most("non-conforming edges", most([](auto& m) { return m.figures.n_nonconforming_edges; }), 0,
                 source);
  report.at_most("triangles turned", most([](auto& m) { return m.figures.n_turned; }), 0, source);
  report.at_least("smallest angle [degrees]", least([](auto& m) { return m.figures.smallest_angle_degrees; }),
                  20, source);
  report.at_least("least median of smallest angles [degrees]",
                  least([](auto& m) { return m.figures.median_angle_degrees; }), 45, source);
  report.at_least("least share of radius ratios above 1/2",
                  least([](auto& m) { return m.figures.share_round; }), 0.99, source);
  report.told("smallest radius ratio", least([](auto& m) { return m.figures.smallest_radius_ratio; }), "");
  report.at_most("vertices from their films [h]", most([](auto& m) { return m.film_distance; }), 0.02,
                 source);
  report.at_most("vertices from their triple lines [h]", most([](auto& m) { return m.border_distance; }),
                 0.02, source);
  report.told("by which films were shifted for the volumes of bubbles [h]",
              most([](auto& m) { return m.film_shift; }), "");
  report.told("volumes of bubbles, relative", most([](auto& m) { return m.volume_error; }), "");
  report.told("largest number of vertices without projection",
              most([](auto& m) { return m.figures.n_unprojected; }), "");
  report.told("largest number of junctions drawn together",
              most([](const Meshing& m) { return m.figures.n_drawn_together; }), "");
  report.told("farthest of those from a film that ends there [h]",
              most([](const Meshing& m) { return m.drawn_together_distance; }), "");
  report.told("steps of relaxation where a T1 was let go on, at most",
              most([](const Meshing& m) { return m.n_relaxation_steps; }), "");
  const double spent = total(networks, which, &Meshing::seconds);
  report.told("processor time over that of a contour",
              spent / total(networks, which, &Meshing::contour_seconds), "");
  const double ratio = spent / total(networks, which, &Meshing::new_seconds);
  if (which == &Network::uniform)
    report.at_most("and of a contour with its vertices projected", ratio, 20,
                   "Sec. 3.3.1: 20 times the cost of the initial mesh");
  else
    report.told("and of a contour with its vertices projected", ratio, "");
}

}  // namespace

void film_meshes(const parallel::Communicator& communicator, Scale scale, Report& report) {
  std::vector<Sequence> sequences{{5, 32, 0.2, 1, 4}, {6, 32, 0.25, 2, 3}, {12, 40, 0.25, 3, 3}};
  if (scale == Scale::Full) {
    for (const Sequence& s : std::initializer_list<Sequence>{{8, 40, 0.2, 4, 3},
                                                             {10, 44, 0.25, 5, 2},
                                                             {16, 50, 0.25, 6, 2},
                                                             {20, 54, 0.25, 7, 2},
                                                             {30, 60, 0.25, 8, 1, 3},
                                                             {50, 64, 0.2, 9, 1, 5},
                                                             {100, 80, 0.2, 10, 1, 10}})
      sequences.push_back(s);
  }
  std::vector<Network> networks;
  for (const Sequence& s : sequences) {
    const std::size_t first = networks.size();
    run_sequence(communicator, s, networks);
    for (std::size_t n = first; n < networks.size(); ++n)
      report.note(fmt::format("{}: {} bubbles, {} lamellae: uniform: {}; graded: {}", networks[n].name,
                              networks[n].bubbles, networks[n].lamellae, line(networks[n].uniform),
                              line(networks[n].graded)));
  }
  report.told("networks", static_cast<double>(networks.size()), "");
  report.at_most("networks whose films, borders or junctions changed",
                 static_cast<double>(std::ranges::count_if(
                     networks, [](const Network& n) { return !n.uniform.same_foam || !n.graded.same_foam; })),
                 0, "the mesh changes, the foam does not");
  report.note("edges of h everywhere:");
  judge(networks, &Network::uniform, report);
  report.note("edges of 0.3 h at borders, growing to h:");
  judge(networks, &Network::graded, report);
}

}  // namespace spume::verification
