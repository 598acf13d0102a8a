// How thin films become along borders and in corners, against references of one dimension and of finer
// meshes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "spume/verification/drainage_runs.hpp"
#include "spume/verification/film_networks.hpp"
#include "spume/verification/refine_films.hpp"
#include "spume/verification/rim_reference.hpp"
#include "spume/verification/tables.hpp"

namespace spume::verification {

namespace {

constexpr double eta0 = 5e-6, lambda = 5e-8;  // at the start [m], held [m²]
constexpr std::array times{0.01, 0.1, 1.0, 4.0, 16.1};

state::Materials weightless() {
  auto materials = fig15_materials();
  materials.gravity = {};
  return materials;
}

/// Distances from a border up to 0.5 mm, the first of them `first`, growing by a seventh.
std::vector<double> graded(double first) {
  std::vector<double> distances{0};
  for (double h = first; distances.back() < 0.5e-3; h *= 8.0 / 7) distances.push_back(distances.back() + h);
  for (double& x : distances) x *= 0.5e-3 / distances.back();
  return distances;
}

/// Mean η over all vertices of films on the border at the times of this file.
std::vector<double> rims_of_strips(double first, double tolerance) {
  const auto network = uniform_network(three_strips(graded(first), std::vector{0.0, 20e-6}), eta0, lambda);
  drainage::DrainageEquations equations(network, weightless());
  std::vector<double> rims;
  drain_with_held_borders(equations, equations.read(network), times, tolerance,
                          [&](std::size_t, const drainage::Unknowns& y) {
                            // The diagonals of the cells make the ends of the border differ by some per cent.
                            double sum = 0;
                            for (const auto& site : equations.sites()) sum += y.film[site.film_dof];
                            rims.push_back(sum / static_cast<double>(equations.sites().size()));
                          });
  return rims;
}

/// Least η at the junction of a corner whose edges are 0.0625 mm away from it, halved by each level of
/// refinement around it; along borders 0.016 mm.
std::vector<double> corners(double extent, int levels, double tolerance) {
  constexpr double spacing = 62.5e-6;
  constexpr int layers = 4;
  auto mesh = tetrahedral_corner(spacing, static_cast<int>(std::lround(extent / spacing)));
  for (int level = 0; level < levels; ++level)
    mesh = refine_around(mesh, level < 2 ? mesh::VertexKind::Border : mesh::VertexKind::Junction, layers,
                         straight_middle);
  const auto network = uniform_network(std::move(mesh), eta0, lambda);
  drainage::DrainageEquations equations(network, weightless());
  std::vector<double> least;
  drain_with_held_borders(equations, equations.read(network), times, tolerance,
                          [&](std::size_t, const drainage::Unknowns& y) {
                            least.push_back(eta0);
                            for (const auto& site : equations.sites())
                              if (network.topology.film_dof[site.film_dof].vertex == 0)
                                least.back() = std::min(least.back(), y.film[site.film_dof]);
                          });
  return least;
}

}  // namespace

void film_rim(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("a flat film 1 mm wide between borders of λ = 0.05 mm², η₀ = 5 μm, without gravity");
  const bool full = scale == Scale::Full;
  const auto exact = rim_of_flat_film({.half_width = 0.5e-3, .half_thickness = eta0, .border_area = lambda},
                                      weightless(), full ? 0.2e-6 : 0.5e-6, times);
  constexpr std::array prior{2.722e-6, 1.055e-6, 0.375e-6, 0.313e-6, 0.226e-6};
  const auto rim = rims_of_strips(full ? 2e-6 : 4e-6, 0.02);
  for (std::size_t n = 0; n < times.size(); ++n) {
    const std::string what = fmt::format("rim at {} s [m]", times[n]);
    report.relative(what + ", one-dimensional", exact[n], prior[n], 0.01, "reference digits");
    report.relative(what, rim[n], exact[n], 0.03, "one-dimensional finite volumes");
  }
}

void film_corner(const parallel::Communicator& /*communicator*/, Scale scale, Report& report) {
  report.note("the corner of flat films that meet at 109.47°, λ = 0.05 mm² held, η₀ = 5 μm, without gravity");
  constexpr std::array prior{1.887e-6, 0.380e-6, 0.0408e-6, 0.0098e-6, 0.0023e-6};
  const bool full = scale == Scale::Full;
  for (const int levels : full ? std::vector{2, 3, 4, 5} : std::vector{2, 3}) {
    const auto corner = corners(full ? 1e-3 : 0.5e-3, levels, 0.02);
    for (std::size_t n = 0; n < times.size(); ++n) {
      const std::string what =
          fmt::format("corner at {} s, edges of {:.3g} mm [m]", times[n], 0.0625 / (1 << levels));
      if (levels == 5)
        report.relative(what, corner[n], prior[n], 0.1, "radially graded to 0.5 μm");
      else
        report.told(what, corner[n], "radially graded to 0.5 μm", prior[n]);
    }
  }
}

}  // namespace spume::verification
