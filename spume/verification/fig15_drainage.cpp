// The foam of the paper's Fig. 15, the exact cluster of four bubbles, drained on finer and finer meshes.
#include <fmt/format.h>

#include <algorithm>
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

constexpr double radius = 1e-3, eta0 = 5e-6, lambda0 = 5e-8, end = 16.1;

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const double s = std::clamp(dot(x - a, b - a) / norm_squared(b - a), 0.0, 1.0);
  return norm(x - a - s * (b - a));
}

/// Least η of a network and where it counts as away from borders.
double least_away_from_borders(const state::FilmNetwork& network, double distance) {
  const auto& position = network.mesh.position;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < network.half_thickness.size(); ++d) {
    if (network.half_thickness[d] >= least) continue;
    const Vec3& x = position[network.topology.film_dof[d].vertex];
    const bool away = std::ranges::none_of(network.topology.border_edge, [&](const auto& edge) {
      return distance_to_segment(x, position[edge.vertex[0]], position[edge.vertex[1]]) < distance;
    });
    if (away) least = network.half_thickness[d];
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
  double n = 0, z = 0, y = 0, zz = 0, zy = 0, lowest = 0, highest = 0;
  const auto height = [&](int v) { return network.mesh.position[v].z; };
  const auto root = [&](int v) { return 1 / std::sqrt(network.border_area[v]); };
  for (const auto& dof : network.topology.border_dof) {
    const double x = height(dof.vertex), r = root(dof.vertex);
    n += 1, z += x, y += r, zz += x * x, zy += x * r;
    lowest = std::min(lowest, x), highest = std::max(highest, x);
  }
  const double slope = (n * zy - z * y) / (n * zz - z * z), offset = (y - slope * z) / n;
  const double law = -materials.liquid.density * materials.gravity.z /
                     (2 * drainage::border_tension(materials.film.surface_tension));
  double bend = 0;
  for (const auto& dof : network.topology.border_dof)
    bend = std::max(bend, std::abs(root(dof.vertex) - offset - slope * height(dof.vertex)));
  return {slope / law, bend / (law * (highest - lowest))};
}

/// What each mesh must show. Liquid of the borders [m³], where it is judged.
void judge(double spacing, double expected_border_liquid, state::FilmNetwork network, Report& report) {
  const std::string mesh = fmt::format("{:.3g} mm: ", 1e3 * spacing);
  const auto materials = fig15_materials();
  report.told(mesh + "triangles", network.mesh.n_triangles(), "this mesh");
  double least = least_of_all(network);
  const auto thinnest = [](const state::FilmNetwork& now) {
    const auto at = std::ranges::min_element(now.half_thickness);
    const int dof = static_cast<int>(at - now.half_thickness.begin());
    const auto [vertex, lamella] = now.topology.film_dof[dof];
    return state::ThinPoint{dof, lamella, *at, now.topology.vertex_kind[vertex]};
  };
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
  if (expected_border_liquid > 0)
    report.relative(mesh + "liquid in borders [m³]", border_liquid(network), expected_border_liquid, 5e-3,
                    "an independent program, meshes of 0.064 and 0.016 mm");
  else
    report.told(mesh + "liquid in borders [m³]", border_liquid(network), "finer meshes", 1.014e-9);
  report.absolute(mesh + "least η 0.1 mm from borders [m]", least_away_from_borders(network, 0.1e-3), 0.39e-6,
                  0.0105e-6, "an independent program: 0.38 to 0.40 μm");
  report.told(mesh + "least η of all [m]", outcome.thinnest.half_thickness, "corners; depends on the mesh");
}

}  // namespace

void fig15_drainage(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("four bubbles of 2 mm, λ₀ = 0.05 mm², η₀ = 5 μm, drained for 16.1 s");
  constexpr int layers = 4;
  const Middle middle = four_bubble_middle(radius);
  double spacing = 0.13e-3;
  mesh::FilmMesh films = four_bubble_films(radius, spacing);
  for (int level = 0; level < (scale == Scale::Full ? 4 : 2); ++level) {
    if (level > 0) {
      films = refine_around(films, level == 1 ? mesh::VertexKind::Film : mesh::VertexKind::Border, layers,
                            middle);
      spacing *= 0.5;
    }
    auto network = uniform_network(films, eta0, lambda0);
    for (std::size_t d = 0; d < network.curvature_squared.size(); ++d) {
      const auto& lamella = network.topology.lamella[network.topology.film_dof[d].lamella];
      network.curvature_squared[d] = lamella.phase_a == 0 ? 2 / (radius * radius) : 0;
    }
    judge(spacing, level == 1 ? 1.008e-9 : level == 3 ? 1.014e-9 : 0, std::move(network), report);
  }
}

}  // namespace spume::verification
