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

/// Least η at vertices at `distance` from the borders and farther.
double least_at_vertices_away_from_borders(const state::FilmNetwork& network, double distance) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < network.half_thickness.size(); ++d)
    if (network.half_thickness[d] < least &&
        distance_from_borders(network, network.mesh.position[network.topology.film_dof[d].vertex]) >=
            distance)
      least = network.half_thickness[d];
  return least;
}

/// Corners of a triangle or of a part of one, and η there.
struct Part {
  std::array<Vec3, 3> corner;
  std::array<double, 3> eta;
};

/// Lowers `least` to the least η of the part at `distance` from the borders and farther. Parts that cannot
/// hold a lower one are left out, the others are quartered until they are a ten-thousandth of the distance
/// wide.
void lower_to_least(const state::FilmNetwork& network, double distance, const Part& part, double& least) {
  if (std::ranges::min(part.eta) >= least) return;  // η is linear
  const auto& [x, eta] = part;
  const Vec3 middle = 1.0 / 3 * (x[0] + x[1] + x[2]);
  const double reach = std::max({norm(x[0] - middle), norm(x[1] - middle), norm(x[2] - middle)});
  const double from_borders = distance_from_borders(network, middle);
  if (from_borders + reach < distance) return;
  if (from_borders - reach >= distance || reach < 1e-4 * distance) {
    least = std::ranges::min(eta);
    return;
  }
  Part half{};  // its corner c is in the middle of the edge opposite to c
  for (int c = 0; c < 3; ++c) {
    half.corner[c] = 0.5 * (x[(c + 1) % 3] + x[(c + 2) % 3]);
    half.eta[c] = 0.5 * (eta[(c + 1) % 3] + eta[(c + 2) % 3]);
  }
  lower_to_least(network, distance, half, least);
  for (int c = 0; c < 3; ++c) {
    Part at_corner = half;
    at_corner.corner[c] = x[c];
    at_corner.eta[c] = eta[c];
    lower_to_least(network, distance, at_corner, least);
  }
}

/// Least η of all points of the films at `distance` from the borders and farther, η linear in each triangle:
/// triangles through which that distance runs count with the part that is farther.
double least_away_from_borders(const state::FilmNetwork& network, double distance) {
  double least = least_at_vertices_away_from_borders(network, distance);
  for (int t = 0; t < network.mesh.n_triangles(); ++t) {
    const auto corner = network.mesh.corners(t);
    Part whole{{corner[0], corner[1], corner[2]}, {}};
    for (int c = 0; c < 3; ++c) whole.eta[c] = network.half_thickness[network.topology.corner_dof[t][c]];
    lower_to_least(network, distance, whole, least);
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
  report.told(mesh + "the same at vertices only [m]", least_at_vertices_away_from_borders(network, 0.1e-3),
              "depends on where vertices lie");
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
