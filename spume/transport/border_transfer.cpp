#include "spume/transport/border_transfer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "spume/transport/border_profile.hpp"

namespace spume::transport {

namespace {

/// A point on a border edge.
struct LinePoint {
  int edge = -1;
  double t = 0;  ///< fraction of the way from the edge's first vertex to its second
};

/// Finds closest points on the edges of borders.
class BorderLocator {
 public:
  BorderLocator(const LiquidMesh& mesh, double bin_size)
      : mesh_(mesh), bins_(midpoints(mesh), bin_size, mesh.films.domain) {
    for (const auto& edge : mesh.topology.border_edge)
      longest_ = std::max(longest_, norm(mesh.films.edge(edge.vertex[0], edge.vertex[1])));
  }

  /// Closest on the edges that `accept` takes, within `reach` [m]; the first of equals in edge order.
  LinePoint closest(const Vec3& x, double reach, const std::function<bool(int edge)>& accept) {
    LinePoint best;
    double best_squared = reach * reach;
    bins_.within(x, reach + 0.5 * longest_, found_);
    for (const Neighbour& near : found_) {
      const auto& edge = mesh_.topology.border_edge[near.point];
      if (!accept(near.point)) continue;
      const Vec3 a = mesh_.films.domain.near(mesh_.films.position[edge.vertex[0]], x);
      const Vec3 along = mesh_.films.edge(edge.vertex[0], edge.vertex[1]);
      const double length_squared = norm_squared(along);
      const double t = length_squared > 0 ? std::clamp(dot(x - a, along) / length_squared, 0.0, 1.0) : 0;
      const double r2 = norm_squared(x - a - t * along);
      if (r2 >= best_squared) continue;
      best_squared = r2;
      best = {near.point, t};
    }
    return best;
  }

 private:
  static std::vector<Vec3> midpoints(const LiquidMesh& mesh) {
    std::vector<Vec3> points;
    for (const auto& edge : mesh.topology.border_edge)
      points.push_back(mesh.films.position[edge.vertex[0]] +
                       0.5 * mesh.films.edge(edge.vertex[0], edge.vertex[1]));
    return points;
  }

  const LiquidMesh& mesh_;
  PointBins bins_;
  double longest_ = 0;
  std::vector<Neighbour> found_;
};

int n_shared(const std::array<mesh::Phase, 3>& a, const std::array<mesh::Phase, 3>& b) {
  int n = 0;
  for (mesh::Phase p : a) n += std::find(b.begin(), b.end(), p) != b.end();
  return n;
}

struct Footprint {
  std::vector<LinePoint> point;           ///< per new dof; edge −1: nowhere
  std::vector<std::pair<int, int>> same;  ///< old and new border
};

Vec3 direction(const LiquidMesh& mesh, int edge) {
  const auto& vertex = mesh.topology.border_edge[edge].vertex;
  return normalized(mesh.films.edge(vertex[0], vertex[1]));
}

/// Direction of the border at each of its dofs, of either sign.
std::vector<Vec3> tangents(const LiquidMesh& mesh) {
  std::vector<Vec3> tangent(mesh.topology.border_dof.size());
  for (std::size_t e = 0; e < mesh.topology.border_edge.size(); ++e) {
    const Vec3 along = direction(mesh, static_cast<int>(e));
    for (int d : mesh.topology.border_edge[e].border_dof)
      tangent[d] += dot(tangent[d], along) < 0 ? -along : along;
  }
  for (Vec3& t : tangent) t = normalized(t);
  return tangent;
}

void find_own_triples(const LiquidMesh& from, BorderLocator& locator, const LiquidMesh& to, double reach,
                      Footprint& footprint) {
  for (std::size_t d = 0; d < footprint.point.size(); ++d) {
    const int border = to.border_of_dof[d];
    const auto& phases = to.topology.border[border].phases;
    footprint.point[d] = locator.closest(to.border_position(static_cast<int>(d)), reach, [&](int edge) {
      return from.topology.border[from.topology.border_edge[edge].border].phases == phases;
    });
    const int edge = footprint.point[d].edge;
    if (edge >= 0 && to.border_length[border] > 0)
      footprint.same.emplace_back(from.topology.border_edge[edge].border, border);
  }
}

/// Last resort, for borders that no old border of their three phases is near: a bubble that split or vanished
/// renames borders too. A border born by a T1 meets the old ones at about 109° and is not taken for one of
/// them.
void find_renamed(const LiquidMesh& from, BorderLocator& locator, const LiquidMesh& to, double reach,
                  Footprint& footprint) {
  constexpr double parallel = 0.7;  // |cos| of the angle between the directions: 45°
  std::vector<char> linked(to.topology.n_borders(), 0);
  for (const auto& [old_border, new_border] : footprint.same) linked[new_border] = 1;
  if (std::find(linked.begin(), linked.end(), 0) == linked.end()) return;
  const std::vector<Vec3> tangent = tangents(to);
  for (std::size_t d = 0; d < footprint.point.size(); ++d) {
    const int border = to.border_of_dof[d];
    if (linked[border] || !(to.border_length[border] > 0)) continue;
    const auto& phases = to.topology.border[border].phases;
    footprint.point[d] = locator.closest(to.border_position(static_cast<int>(d)), reach, [&](int edge) {
      const auto& old_border = from.topology.border[from.topology.border_edge[edge].border];
      return n_shared(old_border.phases, phases) >= 2 &&
             std::abs(dot(direction(from, edge), tangent[d])) > parallel;
    });
    const int edge = footprint.point[d].edge;
    if (edge >= 0) footprint.same.emplace_back(from.topology.border_edge[edge].border, border);
  }
}

/// λ at the new dofs of linked borders. A dof far from the old border takes the mean of its border.
std::vector<double> interpolate(const BorderProfile& lambda, const LiquidMesh& to,
                                const Footprint& footprint) {
  std::vector<double> value(footprint.point.size(), 0);
  for (int b = 0; b < to.topology.n_borders(); ++b) {
    double sum = 0, length = 0;
    for (int d : to.dofs_of_border[b]) {
      if (footprint.point[d].edge < 0) continue;
      value[d] = lambda.at(footprint.point[d].edge, footprint.point[d].t);
      sum += value[d] * to.dof_length[d];
      length += to.dof_length[d];
    }
    for (int d : to.dofs_of_border[b])
      if (footprint.point[d].edge < 0 && length > 0) value[d] = sum / length;
  }
  return value;
}

}  // namespace

BorderTransfer transfer_borders(const LiquidMesh& from, std::span<const double> old_volume,
                                const LiquidMesh& to, double h, const TransportParameters& parameters) {
  // Borders are rougher than films: their vertices lie on three films at once.
  const double reach = 1.5 * parameters.reach * h;
  BorderLocator locator(from, h);
  Footprint footprint;
  footprint.point.resize(to.topology.border_dof.size());
  find_own_triples(from, locator, to, reach, footprint);
  find_renamed(from, locator, to, reach, footprint);

  BorderTransfer transfer;
  transfer.links = link_pieces(from.topology.n_borders(), to.topology.n_borders(), footprint.same);
  transfer.volume = interpolate(BorderProfile(from, old_volume, h), to, footprint);
  for (std::size_t d = 0; d < transfer.volume.size(); ++d) transfer.volume[d] *= to.dof_length[d];
  rescale_groups(transfer.links, {from.border_of_dof, from.dof_length}, old_volume,
                 {to.border_of_dof, to.dof_length}, transfer.volume);
  return transfer;
}

}  // namespace spume::transport
