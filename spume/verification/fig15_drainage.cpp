// The foam of the paper's Fig. 15, the exact cluster of four bubbles, drained on finer and finer meshes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "spume/drainage/constants.hpp"
#include "spume/drainage/drain.hpp"
#include "spume/verification/drainage_runs.hpp"
#include "spume/verification/film_networks.hpp"
#include "spume/verification/four_bubble_films.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

constexpr double radius = 1e-3, end = 16.1;

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const double s = std::clamp(dot(x - a, b - a) / norm_squared(b - a), 0.0, 1.0);
  return norm(x - a - s * (b - a));
}

double distance_from_borders(const state::FilmNetwork& network, const Vec3& x) {
  const auto& position = network.mesh.position;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& edge : network.topology.border_edge)
    nearest = std::min(nearest, distance_to_segment(x, position[edge.vertex[0]], position[edge.vertex[1]]));
  return nearest;
}

/// Distance of every vertex from the nearest border.
std::vector<double> distances_from_borders(const state::FilmNetwork& network) {
  std::vector<double> distance;
  for (const Vec3& x : network.mesh.position) distance.push_back(distance_from_borders(network, x));
  return distance;
}

/// Least η at `distance` from the borders and farther, η and the distance linear along edges: where vertices
/// happen to lie does not matter. Corners of films, where the place is between edges, are missed by as much
/// as the mesh is coarse.
double least_away_from_borders(const state::FilmNetwork& network, double distance) {
  const auto from_borders = distances_from_borders(network);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& dof : network.topology.corner_dof)
    for (int c = 0; c < 3; ++c) {
      const std::array<int, 2> ends{dof[c], dof[(c + 1) % 3]};
      std::array<double, 2> far{}, eta{};
      for (int e = 0; e < 2; ++e) {
        far[e] = from_borders[network.topology.film_dof[ends[e]].vertex] - distance;
        eta[e] = network.half_thickness[ends[e]];
        if (far[e] >= 0) least = std::min(least, eta[e]);
      }
      if ((far[0] < 0) != (far[1] < 0))
        least = std::min(least, (eta[0] * far[1] - eta[1] * far[0]) / (far[1] - far[0]));
    }
  return least;
}

/// The same in whole triangles, η linear in each, at points a twelfth of an edge apart whose distances are
/// the true ones.
double least_in_triangles_away_from_borders(const state::FilmNetwork& network, double distance) {
  constexpr int n_parts = 12;
  const auto from_borders = distances_from_borders(network);
  double least = least_away_from_borders(network, distance);
  for (int t = 0; t < network.mesh.n_triangles(); ++t) {
    const auto corner = network.mesh.corners(t);
    const auto& vertex = network.mesh.triangle[t].vertex;
    std::array<double, 3> eta{};
    for (int c = 0; c < 3; ++c) eta[c] = network.half_thickness[network.topology.corner_dof[t][c]];
    // Nowhere in the triangle is the distance larger than this, nor η smaller than at a corner.
    const double farthest =
        from_borders[vertex[0]] + std::max(norm(corner[1] - corner[0]), norm(corner[2] - corner[0]));
    if (farthest < distance || std::ranges::min(eta) >= least) continue;
    for (int i = 0; i <= n_parts; ++i)
      for (int j = 0; i + j <= n_parts; ++j) {
        const double a = static_cast<double>(i) / n_parts, b = static_cast<double>(j) / n_parts,
                     c = 1 - a - b;
        const double here = a * eta[0] + b * eta[1] + c * eta[2];
        if (here < least &&
            distance_from_borders(network, a * corner[0] + b * corner[1] + c * corner[2]) >= distance)
          least = here;
      }
  }
  return least;
}

double border_liquid(const state::FilmNetwork& network) {
  double sum = 0;
  for (const auto& edge : network.topology.border_edge)
    for (int v : edge.vertex)
      sum += 0.5 * norm(network.mesh.edge(edge.vertex[0], edge.vertex[1])) * network.border_area[v];
  return sum;
}

/// The least positive-looking number of all η and λ: positive if all are.
double least_of_all(const state::FilmNetwork& network) {
  double least = std::ranges::min(network.half_thickness);
  for (const auto& dof : network.topology.border_dof)
    least = std::min(least, network.border_area[dof.vertex]);
  return least;
}

/// λ^(−1/2) against height, by least squares: slope over the hydrostatic one, and the largest distance from
/// the line over its rise.
struct Profile {
  double slope, bend;
};
Profile border_profile(const state::FilmNetwork& network, const state::Materials& materials) {
  const Vec3 up = normalized(-1.0 * materials.gravity);
  double n = 0, z = 0, y = 0, zz = 0, zy = 0, lowest = 0, highest = 0;
  const auto height = [&](int v) { return dot(up, network.mesh.position[v]); };
  const auto root = [&](int v) { return 1 / std::sqrt(network.border_area[v]); };
  for (const auto& dof : network.topology.border_dof) {
    const double x = height(dof.vertex), r = root(dof.vertex);
    n += 1, z += x, y += r, zz += x * x, zy += x * r;
    lowest = std::min(lowest, x), highest = std::max(highest, x);
  }
  const double slope = (n * zy - z * y) / (n * zz - z * z), offset = (y - slope * z) / n;
  const double law = materials.liquid.density * norm(materials.gravity) /
                     (2 * drainage::border_tension(materials.film.surface_tension));
  double bend = 0;
  for (const auto& dof : network.topology.border_dof)
    bend = std::max(bend, std::abs(root(dof.vertex) - offset - slope * height(dof.vertex)));
  return {slope / law, bend / (law * (highest - lowest))};
}

state::ThinPoint thinnest(const state::FilmNetwork& network) {
  const auto least = std::ranges::min_element(network.half_thickness);
  const int dof = static_cast<int>(least - network.half_thickness.begin());
  const auto [vertex, lamella] = network.topology.film_dof[dof];
  return {dof, lamella, *least, network.topology.vertex_kind[vertex]};
}

/// What an independent program found with one bubble lowest: liquid in the borders [m³] and
/// the least η 0.1 mm away from them [m]; 0 where it tells nothing of this mesh.
struct Reference {
  double border_liquid, least_away;
};

/// Drains and shows what every mesh must.
void judge(const std::string& mesh, state::FilmNetwork network, const state::Materials& materials,
           const Reference& reference, Report& report) {
  double least = least_of_all(network);
  const auto outcome =
      drainage::drain(network, materials, {.max_time = end, .tolerance = 0.02, .max_step = 10}, 0, thinnest,
                      [&](const drainage::DrainageProgress&, const state::FilmNetwork& now) {
                        least = std::min(least, least_of_all(now));
                        return true;
                      });
  report.at_most(mesh + "steps and rejected steps", outcome.n_steps + outcome.n_rejected, 100, "cost");
  report.at_least(mesh + "least η or λ of all states", least, std::numeric_limits<double>::min(), "positive");
  report.at_most(mesh + "ledger", std::abs(outcome.ledger_error), 1e-13, "nothing is lost");
  const Profile profile = border_profile(network, materials);
  report.relative(mesh + "slope of λ^(-1/2) over ρg/(2C₁)", profile.slope, 1, 1e-3, "hydrostatics");
  report.at_most(mesh + "distance from the line over its rise", profile.bend, 1e-3, "hydrostatics");
  const char* const independent = "an independent computation with the same equations";
  if (reference.border_liquid > 0)
    report.relative(mesh + "liquid in borders [m³]", border_liquid(network), reference.border_liquid, 5e-3,
                    independent);
  else
    report.told(mesh + "liquid in borders [m³]", border_liquid(network), "finer meshes: see below");
  const double away = least_away_from_borders(network, 0.1e-3);
  if (reference.least_away > 0)
    report.absolute(mesh + "least η 0.1 mm from borders [m]", away, reference.least_away, 0.01e-6,
                    independent);
  else
    report.told(mesh + "least η 0.1 mm from borders [m]", away, "this mesh");
  report.told(mesh + "the same in whole triangles [m]", least_in_triangles_away_from_borders(network, 0.1e-3),
              "smallest at corners of films, between edges");
  report.told(mesh + "least η of all [m]", outcome.thinnest.half_thickness, "corners; depends on the mesh");
}

}  // namespace

void fig15_drainage(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("four bubbles of 2 mm, λ₀ = 0.05 mm², η₀ = 5 μm, drained for 16.1 s: on three bubbles, as in");
  report.note(
      "Fig. 15, and with one bubble lowest, tilted so that the borders span 2.13 mm, as in the reference");
  const Vec3 tilted_up = normalized(Vec3{-0.429, -0.468, -0.773});
  constexpr std::array references{Reference{0, 0.39e-6}, Reference{1.008e-9, 0.39e-6}, Reference{0, 0.39e-6},
                                  Reference{1.014e-9, 0}};
  constexpr int layers = 4;
  const int n_meshes = scale == Scale::Full ? 4 : 2;
  double spacing = 0.13e-3;
  mesh::FilmMesh films = four_bubble_films(radius, spacing);
  for (int level = 0; level < n_meshes; ++level) {
    if (level > 0) {
      films = refine_around(films, level == 1 ? mesh::VertexKind::Film : mesh::VertexKind::Border, layers,
                            four_bubble_middle(radius));
      spacing *= 0.5;
    }
    const std::string mesh = fmt::format("{:.3g} mm", 1e3 * spacing);
    report.told(mesh + ": triangles", films.n_triangles(), "this mesh");
    auto materials = fig15_materials();
    judge(mesh + ", on three: ", four_bubble_network(films, radius), materials,
          {references[level].border_liquid, 0}, report);
    materials.gravity = -norm(materials.gravity) * tilted_up;
    judge(mesh + ", one lowest: ", four_bubble_network(films, radius), materials, references[level], report);
  }
}

}  // namespace spume::verification
