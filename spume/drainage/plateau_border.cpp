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
  const double root = std::sqrt(a * b);
  const double mobility = root * (a + root + b);        // 3 × that of the edge
  const auto slope = [root](double at, double other) {  // of 3 × the mobility, by one end
    return 0.5 * other * (at + other) / root + root + other;
  };
  const double drive = 2 * c1 * (1 / std::sqrt(b) - 1 / std::sqrt(a)) + rho * link.descent;
  return {conductance * mobility * drive,
          {conductance * (slope(a, b) * drive + mobility * c1 / (a * std::sqrt(a))),
           conductance * (slope(b, a) * drive - mobility * c1 / (b * std::sqrt(b)))}};
}

void add_border_flow(const BorderNetwork& borders, std::span<const double> lambda,
                     const state::Materials& materials, std::span<double> rate) {
  for (const auto& link : borders.link) {
    const auto [from, to] = link.unknown;
    const double flow = border_flux(lambda[from], lambda[to], link, materials).value;
    rate[from] -= flow;
    rate[to] += flow;
  }
}

}  // namespace spume::drainage
