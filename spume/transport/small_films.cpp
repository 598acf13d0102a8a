#include "spume/transport/small_films.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spume/transport/donors.hpp"

namespace spume::transport {

namespace {

double total(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double edge_length(const LiquidMesh& mesh, int edge) {
  const auto& vertex = mesh.topology.border_edge[edge].vertex;
  return norm(mesh.films.edge(vertex[0], vertex[1]));
}

/// Volume a unit of area [m] of the other films within donor_radius + √area of the middle of a lamella; 0:
/// none there.
double thickness_around(const LiquidMesh& mesh, int lamella, double radius,
                        std::span<const double> film_volume) {
  const Vec3 start = mesh.film_position(mesh.dofs_of_lamella[lamella].front());
  Vec3 middle = start;
  for (int d : mesh.dofs_of_lamella[lamella])
    middle += (mesh.dof_area[d] / mesh.lamella_area[lamella]) *
              mesh.films.domain.step(start, mesh.film_position(d));
  std::vector<Neighbour> found;
  mesh.film_bins.within(middle, radius, found);
  double volume = 0, area = 0;
  for (const Neighbour& near : found) {
    if (mesh.lamella_of_dof[near.point] == lamella) continue;
    volume += film_volume[near.point];
    area += mesh.dof_area[near.point];
  }
  return area > 0 ? volume / area : 0;
}

/// What is missing to the floor at the dofs of a piece, and how to fill it.
struct Shortage {
  std::span<const int> dofs;
  std::span<const double> measure;
  double floor;  ///< volume a unit of measure

  double at(int dof, std::span<const double> volume) const {
    return std::max(0.0, floor * measure[dof] - volume[dof]);
  }
  double sum(std::span<const double> volume) const {
    double missing = 0;
    for (int d : dofs) missing += at(d, volume);
    return missing;
  }
  void fill(double amount, std::span<double> volume) const {
    const double share = amount / sum(volume);
    for (int d : dofs) volume[d] += share * at(d, volume);
  }
};

/// Takes up to `wanted` from the borders on the rim of a lamella; they keep half the mean cross-section of
/// all borders.
double borrow_from_rim(const LiquidMesh& mesh, int lamella, double wanted, std::span<double> border_volume) {
  const double length = total(mesh.dof_length);
  if (!(length > 0)) return 0;
  const double keep = 0.5 * total(border_volume) / length;
  std::vector<int> borders;
  for (int e : mesh.edges_of_lamella[lamella]) borders.push_back(mesh.topology.border_edge[e].border);
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  const auto excess = [&](int d) { return std::max(0.0, border_volume[d] - keep * mesh.dof_length[d]); };
  double available = 0;
  for (int b : borders)
    for (int d : mesh.dofs_of_border[b]) available += excess(d);
  if (!(available > 0)) return 0;
  const double fraction = std::min(1.0, wanted / available);
  for (int b : borders)
    for (int d : mesh.dofs_of_border[b]) border_volume[d] -= fraction * excess(d);
  return fraction * available;
}

/// Takes up to `wanted` from donors, each by its weight and only from what it has above `keep` a unit of
/// measure: asked at every step, a donor would be emptied by fractions of all it has.
double borrow(const Donors& donors, double keep, std::span<const double> measure, double wanted,
              std::span<double> volume) {
  const auto excess = [&](std::size_t n) {
    const int d = donors.dof[n];
    return donors.weight[n] * std::max(0.0, volume[d] - keep * measure[d]);
  };
  double available = 0;
  for (std::size_t n = 0; n < donors.dof.size(); ++n) available += excess(n);
  if (!(available > 0) || !(wanted > 0)) return 0;
  const double fraction = std::min(1.0, wanted / available);
  for (std::size_t n = 0; n < donors.dof.size(); ++n) volume[donors.dof[n]] -= fraction * excess(n);
  return fraction * available;
}

/// Volume a unit of area of all grown lamellae [m].
double grown_thickness(const LiquidMesh& mesh, std::span<const char> is_young,
                       std::span<const double> volume) {
  double sum = 0, area = 0;
  for (std::size_t d = 0; d < volume.size(); ++d) {
    if (is_young[mesh.lamella_of_dof[d]]) continue;
    sum += volume[d];
    area += mesh.dof_area[d];
  }
  return area > 0 ? sum / area : 0;
}

/// A film that is born is drawn out of the Plateau borders around it, not out of the thin rims of its
/// neighbours: the floor refers to the mean of all grown films where that is thicker than the films nearby.
double fill_lamella(const LiquidMesh& mesh, int lamella, std::span<const char> is_young, double grown,
                    double h, const TransportParameters& parameters, NewLiquid liquid) {
  std::vector<Vec3> points;
  for (int d : mesh.dofs_of_lamella[lamella]) points.push_back(mesh.film_position(d));
  const Donors donors = find_donors(mesh.film_bins, points, parameters.donor_radius * h, 3, Falloff::Linear,
                                    [&](int dof) { return !is_young[mesh.lamella_of_dof[dof]]; });
  const double donor_area = donors.sum(mesh.dof_area);
  if (!(donor_area > 0)) return 0;
  const double mean = donors.sum(liquid.film) / donor_area;
  const Shortage shortage{mesh.dofs_of_lamella[lamella], mesh.dof_area,
                          parameters.floor * std::max(mean, grown)};
  const double wanted = shortage.sum(liquid.film);
  if (!(wanted > 0)) return 0;
  double moved = borrow_from_rim(mesh, lamella, wanted, liquid.border);
  moved += borrow(donors, 0.5 * mean, mesh.dof_area, wanted - moved, liquid.film);
  shortage.fill(moved, liquid.film);
  return moved;
}

std::vector<char> growing_borders(const LiquidMesh& mesh, std::span<const char> is_young,
                                  double short_length) {
  std::vector<char> growing(mesh.topology.n_borders(), 0);
  for (const auto& edge : mesh.topology.border_edge)
    for (int t : edge.triangle)
      if (is_young[mesh.topology.triangle_lamella[t]]) growing[edge.border] = 1;
  for (int b = 0; b < mesh.topology.n_borders(); ++b)
    if (mesh.border_length[b] < short_length) growing[b] = 1;
  return growing;
}

double fill_border(const LiquidMesh& mesh, int border, std::span<const char> growing, double h,
                   const TransportParameters& parameters, std::span<double> volume) {
  std::vector<Vec3> points;
  for (int d : mesh.dofs_of_border[border]) points.push_back(mesh.border_position(d));
  const auto donors_among = [&](const std::function<bool(int dof)>& accept) {
    return find_donors(mesh.border_bins, points, parameters.border_radius * h, 3, Falloff::Linear, accept);
  };
  Donors donors = donors_among([&](int dof) { return !growing[mesh.border_of_dof[dof]]; });
  const bool is_empty = std::all_of(mesh.dofs_of_border[border].begin(), mesh.dofs_of_border[border].end(),
                                    [&](int d) { return volume[d] <= 0; });
  if (donors.empty() && is_empty)  // in a small foam all borders around may be growing
    donors = donors_among([&](int dof) { return mesh.border_of_dof[dof] != border; });
  const double donor_length = donors.sum(mesh.dof_length);
  if (!(donor_length > 0)) return 0;
  const double mean = donors.sum(volume) / donor_length;
  const Shortage shortage{mesh.dofs_of_border[border], mesh.dof_length, parameters.floor * mean};
  const double wanted = shortage.sum(volume);
  if (!(wanted > 0)) return 0;
  const double moved = borrow(donors, 0.5 * mean, mesh.dof_length, wanted, volume);
  shortage.fill(moved, volume);
  return moved;
}

}  // namespace

void cap_small_films(const Links& film_links, const LiquidMesh& mesh, double h,
                     const TransportParameters& parameters, NewLiquid liquid, TransferReport& report) {
  for (int l = 0; l < mesh.topology.n_lamellae(); ++l) {
    const double area = mesh.lamella_area[l];
    if (film_links.group_of_new[l] < 0 || !(area > 0) || area >= parameters.small_area * h * h) continue;
    double rim = 0, holds = 0;
    for (int e : mesh.edges_of_lamella[l]) rim += edge_length(mesh, e);
    for (int d : mesh.dofs_of_lamella[l]) holds += liquid.film[d];
    const double around =
        thickness_around(mesh, l, parameters.donor_radius * h + std::sqrt(area), liquid.film);
    const double most = parameters.cap * around * area;
    if (!(around > 0) || !(rim > 0) || holds <= most) continue;
    for (int d : mesh.dofs_of_lamella[l]) liquid.film[d] *= most / holds;
    const double excess = holds - most;
    for (int e : mesh.edges_of_lamella[l])
      for (int d : mesh.topology.border_edge[e].border_dof)
        liquid.border[d] += 0.5 * excess * (edge_length(mesh, e) / rim);
    report.capped += excess;
  }
}

std::vector<char> young_lamellae(const Links& film_links, const LiquidMesh& to,
                                 std::span<const char> old_is_young,
                                 std::span<const double> old_area_at_transfer, double h,
                                 const TransportParameters& parameters) {
  struct Group {
    double largest = -1, old_area = 0, new_area = 0;
    bool young = false;
  };
  std::vector<Group> groups(film_links.n_groups);
  for (std::size_t l = 0; l < old_is_young.size(); ++l) {
    if (film_links.group_of_old[l] < 0) continue;
    Group& group = groups[film_links.group_of_old[l]];
    group.old_area += old_area_at_transfer[l];
    if (old_area_at_transfer[l] <= group.largest) continue;
    group.largest = old_area_at_transfer[l];
    group.young = old_is_young[l];
  }
  for (int l = 0; l < to.topology.n_lamellae(); ++l)
    if (film_links.group_of_new[l] >= 0) groups[film_links.group_of_new[l]].new_area += to.lamella_area[l];

  std::vector<char> young(to.topology.n_lamellae(), 1);
  for (int l = 0; l < to.topology.n_lamellae(); ++l) {
    if (film_links.group_of_new[l] < 0) continue;
    const Group& group = groups[film_links.group_of_new[l]];
    young[l] = to.lamella_area[l] < parameters.small_area * h * h ||
               (group.young && group.new_area > 1.02 * group.old_area);
  }
  return young;
}

double fill_young(const LiquidMesh& mesh, std::span<const char> is_young, double h,
                  const TransportParameters& parameters, NewLiquid liquid) {
  double moved = 0;
  const double grown = grown_thickness(mesh, is_young, liquid.film);
  for (int l = 0; l < mesh.topology.n_lamellae(); ++l)
    if (is_young[l]) moved += fill_lamella(mesh, l, is_young, grown, h, parameters, liquid);
  const std::vector<char> growing = growing_borders(mesh, is_young, std::sqrt(parameters.small_area) * h);
  for (int b = 0; b < mesh.topology.n_borders(); ++b)
    if (growing[b]) moved += fill_border(mesh, b, growing, h, parameters, liquid.border);
  return moved;
}

}  // namespace spume::transport
