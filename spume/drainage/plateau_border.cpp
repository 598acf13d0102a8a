#include "spume/drainage/plateau_border.hpp"

#include <algorithm>
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

BorderRoot border_root(double lambda) {
  const double root = std::sqrt(lambda);
  return {root, 1 / root};
}

void evaluate_border_roots(std::span<const double> lambda, std::vector<BorderRoot>& result) {
  result.resize(lambda.size());
  std::transform(lambda.begin(), lambda.end(), result.begin(), border_root);
}

BorderFlux border_flux(const BorderRoot& a, const BorderRoot& b, const BorderLink& link,
                       const state::Materials& materials) {
  const double c1 = border_tension(materials.film.surface_tension);  // C₁ [N/m]
  const double mu = materials.liquid.viscosity;                      // μ [Pa s]
  const double rho = materials.liquid.density;                       // ρ [kg/m³]
  const double conductance = border_flow / (3 * mu * link.length);
  const double area_a = a.root * a.root, area_b = b.root * b.root, between = a.root * b.root;
  const double mobility = between * (area_a + between + area_b);  // 3 × that of the edge
  const double mean = 0.5 * (area_a + area_b);
  const double slope_a = mean * b.root * a.inverse + between + area_b;  // of 3 × the mobility, by a
  const double slope_b = mean * a.root * b.inverse + between + area_a;
  const double weight = rho * link.descent;
  const double drive = 2 * c1 * (b.inverse - a.inverse) + weight;
  return {conductance * mobility * drive,
          {conductance * (slope_a * weight + 3 * c1 * a.root),
           conductance * (slope_b * weight - 3 * c1 * b.root)}};
}

void add_border_flow(const BorderNetwork& borders, std::span<const BorderRoot> root,
                     const state::Materials& materials, std::span<double> rate) {
  const state::Materials own = materials;  // which writing rates cannot change
  for (const auto& link : borders.link) {
    const auto [from, to] = link.unknown;
    const double flow = border_flux(root[from], root[to], link, own).value;
    rate[from] -= flow;
    rate[to] += flow;
  }
}

void linearise_border_flow(const BorderNetwork& borders, std::span<const BorderRoot> root,
                           const state::Materials& materials, std::span<double> rate,
                           std::span<std::array<double, 2>> slope) {
  const state::Materials own = materials;
  for (std::size_t n = 0; n < borders.link.size(); ++n) {
    const auto [from, to] = borders.link[n].unknown;
    const BorderFlux flux = border_flux(root[from], root[to], borders.link[n], own);
    rate[from] -= flux.value;
    rate[to] += flux.value;
    slope[n] = flux.slope;
  }
}

}  // namespace spume::drainage
