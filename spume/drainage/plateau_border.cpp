#include "spume/drainage/plateau_border.hpp"

#include <cmath>

#include "spume/drainage/constants.hpp"
#include "spume/drainage/place.hpp"
#include "spume/fem/triangle_matrices.hpp"

namespace spume::drainage {

BorderNetwork build_border_network(const state::FilmNetwork& network, const Vec3& gravity) {
  const auto& position = network.mesh.position;
  BorderNetwork borders;
  borders.unknown_of_vertex.assign(network.mesh.n_vertices(), -1);
  for (const auto& edge : network.topology.border_edge)
    for (int v : edge.vertex) borders.unknown_of_vertex[v] = 0;
  for (int v = 0; v < network.mesh.n_vertices(); ++v) {
    if (borders.unknown_of_vertex[v] < 0) continue;
    borders.unknown_of_vertex[v] = borders.size();
    borders.vertex.push_back(v);
  }
  borders.length.assign(borders.size(), 0.0);
  for (const auto& edge : network.topology.border_edge) {
    const Vec3 x0 = position[edge.vertex[0]], x1 = x0 + network.mesh.edge(edge.vertex[0], edge.vertex[1]);
    const double h = fem::segment_length(x0, x1);
    if (!(h > 0)) throw_at("an edge of a Plateau border has no length", x0);
    const std::array<int, 2> unknown = {borders.unknown_of_vertex[edge.vertex[0]],
                                        borders.unknown_of_vertex[edge.vertex[1]]};
    borders.link.push_back({unknown, h, dot(gravity, x1 - x0)});
    for (int u : unknown) borders.length[u] += fem::lumped_segment_mass(h);
  }
  return borders;
}

BorderFlux border_flux(double a, double b, const BorderLink& link, const state::Materials& materials) {
  const double c1 = border_tension(materials.film.surface_tension);  // C₁ [N/m]
  const double mu = materials.liquid.viscosity;                      // μ [Pa s]
  const double rho = materials.liquid.density;                       // ρ [kg/m³]
  const double conductance = border_flow / (3 * mu * link.length);
  const double root_a = std::sqrt(a), root_b = std::sqrt(b);
  const double inverse_a = 1 / root_a, inverse_b = 1 / root_b;
  const double root = root_a * root_b;
  const double mobility = root * (a + root + b);  // 3 × that of the edge
  // Of 3 × the mobility, by a and by b.
  const double slope_a = 0.5 * (a + b) * root_b * inverse_a + root + b;
  const double slope_b = 0.5 * (a + b) * root_a * inverse_b + root + a;
  const double drive = 2 * c1 * (inverse_b - inverse_a) + rho * link.descent;
  return {conductance * mobility * drive,
          {conductance * (slope_a * drive + mobility * c1 * inverse_a * inverse_a * inverse_a),
           conductance * (slope_b * drive - mobility * c1 * inverse_b * inverse_b * inverse_b)}};
}

void add_border_flow(const BorderNetwork& borders, std::span<const double> lambda,
                     const state::Materials& materials, std::span<double> rate) {
  const state::Materials own = materials;  // which writing rates cannot change
  for (const auto& link : borders.link) {
    const auto [from, to] = link.unknown;
    const double flow = border_flux(lambda[from], lambda[to], link, own).value;
    rate[from] -= flow;
    rate[to] += flow;
  }
}

void linearise_border_flow(const BorderNetwork& borders, std::span<const double> lambda,
                           const state::Materials& materials, std::span<double> rate,
                           std::span<std::array<double, 2>> slope) {
  const state::Materials own = materials;
  for (std::size_t n = 0; n < borders.link.size(); ++n) {
    const auto [from, to] = borders.link[n].unknown;
    const BorderFlux flux = border_flux(lambda[from], lambda[to], borders.link[n], own);
    rate[from] -= flux.value;
    rate[to] += flux.value;
    slope[n] = flux.slope;
  }
}

}  // namespace spume::drainage
