#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/base/stage_times.hpp"
#include "spume/interface/reconstruct.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/volume_constraint.hpp"
#include "spume/meshing/figures.hpp"
#include "spume/meshing/mesh_films.hpp"
#include "spume/simulation/equilibrate.hpp"
#include "spume/verification/foam_run.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

constexpr double cells_per_radius = 5;

/// How one network was meshed.
struct Meshing {
  meshing::MeshFigures figures;
  double film_distance, border_distance, drawn_together_distance;  // [h]
  double seconds;                                                  // of processor time
};

/// One network, meshed uniformly and graded.
struct Network {
  std::string name;
  int bubbles, lamellae;
  Meshing uniform, graded;
  bool same_foam;                       // lamellae, borders and junctions are those from before
  double contour_seconds, new_seconds;  // a contour alone; a contour with its vertices projected
};

/// Processor time that a reconstruction spent on a stage [s].
double seconds(const StageTimes& times, std::string_view stage) {
  double sum = 0;
  for (const auto& [name, s] : times.seconds())
    if (name == stage) sum += s;
  return sum;
}

meshing::MeshingParameters with_coarsest_at_borders(double edge) {
  meshing::MeshingParameters parameters;
  parameters.coarsest_at_borders = edge;
  return parameters;
}

/// The mesh as drainage gets it, with the volumes of the bubbles restored.
Meshing mesh_films(mesh::FilmMesh films, const mesh::Projection& project, const state::Phases& phases,
                   double h, double edge_at_borders, mesh::Topology& topology) {
  const double start = processor_time();
  meshing::improve(films, project, h, with_coarsest_at_borders(edge_at_borders));
  Meshing meshing{};
  meshing.seconds = processor_time() - start;
  mesh::restore_volumes(films, phases.target_volume, 3, 0.1 * h);
  topology = mesh::build_topology(films);
  meshing.figures = meshing::figures_of(films, topology, project);
  meshing.film_distance = meshing.figures.film_distance / h;
  meshing.border_distance = meshing.figures.border_distance / h;
  meshing.drawn_together_distance = meshing.figures.drawn_together_distance / h;
  return meshing;
}

/// Makes the meshes for drainage of a foam as it is, leaving the foam alone.
Network mesh_network(FoamRun& run, const std::string& name) {
  constexpr double fine = 0.3;
  state::Phases phases = run.foam().phases;
  const double h = run.grid().h();
  const auto reconstruction =
      interface::reconstruct(run.grid(), run.foam().films, phases, run.run_case().reconstruct);
  const auto project = interface::projection_onto(reconstruction.potentials);
  const mesh::Topology before = mesh::build_topology(reconstruction.films);
  const auto is_same = [&](const mesh::Topology& after) {
    return after.n_lamellae() == before.n_lamellae() && after.n_borders() == before.n_borders() &&
           after.n_junctions() == before.n_junctions();
  };

  Network network{};
  network.name = name;
  network.bubbles = phases.n_bubbles();
  network.lamellae = before.n_lamellae();
  mesh::Topology uniform, graded;
  network.uniform = mesh_films(reconstruction.films, project, phases, h, 1, uniform);
  network.graded = mesh_films(reconstruction.films, project, phases, h, fine, graded);
  network.same_foam = is_same(uniform) && is_same(graded);
  const auto& times = reconstruction.report.times;
  network.contour_seconds = seconds(times, "contour");
  network.new_seconds = network.contour_seconds + seconds(times, "projection");
  return network;
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
  return fmt::format("{} triangles; angle {:.1f}, median {:.1f}; off by {:.4f}, {:.4f} h", f.n_triangles,
                     f.smallest_angle_degrees, f.median_angle_degrees, m.film_distance, m.border_distance);
}

using Figure = std::function<double(const Meshing&)>;

double largest(const std::vector<Network>& networks, Meshing Network::*which, const Figure& figure) {
  double value = -1e300;
  for (const Network& n : networks) value = std::max(value, figure(n.*which));
  return value;
}

double total(const std::vector<Network>& networks, double Network::*what) {
  double sum = 0;
  for (const Network& n : networks) sum += n.*what;
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
  report.told("largest number of vertices without projection",
              most([](auto& m) { return m.figures.n_unprojected; }), "");
  report.told("largest number of junctions drawn together",
              most([](const Meshing& m) { return m.figures.n_drawn_together; }), "");
  report.told("farthest of those from a film that ends there [h]",
              most([](const Meshing& m) { return m.drawn_together_distance; }), "");
  double spent = 0;
  for (const Network& n : networks) spent += (n.*which).seconds;
  report.told("processor time over that of a contour", spent / total(networks, &Network::contour_seconds),
              "");
  const double ratio = spent / total(networks, &Network::new_seconds);
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
                 static_cast<double>(std::ranges::count(networks, false, &Network::same_foam)), 0,
                 "the mesh changes, the foam does not");
  report.note("edges of h everywhere:");
  judge(networks, &Network::uniform, report);
  report.note("edges of 0.3 h at borders, growing to h:");
  judge(networks, &Network::graded, report);
}

}  // namespace spume::verification
