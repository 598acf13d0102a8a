#include "spume/transport/film_transfer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "spume/mesh/locate.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/transport/film_gradient.hpp"

namespace spume::transport {

namespace {

/// η of the old mesh, ready to be evaluated anywhere on it.
class HalfThickness {
 public:
  HalfThickness(const LiquidMesh& mesh, std::span<const double> volume, double h)
      : mesh_(mesh), value_(volume.size()) {
    // A dof without area (a sliver) must not divide by zero.
    const double least_area = 1e-9 * h * h;
    for (std::size_t d = 0; d < value_.size(); ++d)
      value_[d] = volume[d] / (2 * std::max(mesh.dof_area[d], least_area));
    gradient_ = film_gradient(mesh, value_);
    least_around_ = most_around_ = value_;
    for (const auto& dof : mesh.topology.corner_dof) {
      const auto [low, high] = std::minmax({value_[dof[0]], value_[dof[1]], value_[dof[2]]});
      for (int d : dof) {
        least_around_[d] = std::min(least_around_[d], low);
        most_around_[d] = std::max(most_around_[d], high);
      }
    }
  }

  double at(const mesh::SurfacePoint& point) const {
    const auto& dof = mesh_.topology.corner_dof[point.triangle];
    const auto& w = point.weight;
    double value = w[0] * value_[dof[0]] + w[1] * value_[dof[1]] + w[2] * value_[dof[2]];
    for (int e = 0; e < 3; ++e) {
      const int i = e, j = (e + 1) % 3;
      const Vec3 edge = mesh_.films.domain.step(mesh_.film_position(dof[i]), mesh_.film_position(dof[j]));
      value += 0.5 * w[i] * w[j] * dot(gradient_[dof[i]] - gradient_[dof[j]], edge);
    }
    return std::clamp(value, std::min({least_around_[dof[0]], least_around_[dof[1]], least_around_[dof[2]]}),
                      std::max({most_around_[dof[0]], most_around_[dof[1]], most_around_[dof[2]]}));
  }

 private:
  const LiquidMesh& mesh_;
  std::vector<double> value_, least_around_, most_around_;
  std::vector<Vec3> gradient_;
};

using Triangle = mesh::FilmTriangle;

/// Where the new dofs lie on the old film, and which lamellae that makes the same.
struct Footprint {
  std::vector<mesh::SurfacePoint> point;  ///< per new dof; triangle −1: nowhere
  std::vector<std::pair<int, int>> same;  ///< old and new lamella
};

/// Each rank looks for its share of the dofs.
void find_own_pairs(const parallel::Communicator& ranks, const LiquidMesh& from,
                    const mesh::TriangleLocator& locator, const LiquidMesh& to, double reach,
                    Footprint& footprint) {
  const int n_dofs = static_cast<int>(footprint.point.size());
  const std::vector<int> share = ranks.shares(n_dofs);
  for (int d = share[ranks.rank()]; d < share[ranks.rank() + 1]; ++d) {
    const auto& own = to.topology.lamella[to.lamella_of_dof[d]];
    footprint.point[d] = locator.closest(to.film_position(d), reach, [&](int t) {
      const Triangle& triangle = from.films.triangle[t];
      return triangle.phase_a == own.phase_a && triangle.phase_b == own.phase_b;
    });
  }
  ranks.all_gather(std::span(footprint.point), share);
  for (int d = 0; d < n_dofs; ++d) {
    const int lamella = to.lamella_of_dof[d];
    const int t = footprint.point[d].triangle;
    if (t >= 0 && to.lamella_area[lamella] > 0)
      footprint.same.emplace_back(from.topology.triangle_lamella[t], lamella);
  }
}

/// Last resort, for lamellae that no old film of their pair is near.
void find_renamed(const LiquidMesh& from, const mesh::TriangleLocator& locator, const LiquidMesh& to,
                  double reach, Footprint& footprint) {
  constexpr double parallel = 0.7;  // |cos| of the angle between the normals: 45°
  std::vector<char> linked(to.topology.n_lamellae(), 0);
  for (const auto& [old_lamella, new_lamella] : footprint.same) linked[new_lamella] = 1;
  if (std::find(linked.begin(), linked.end(), 0) == linked.end()) return;
  const std::vector<Vec3> normals = mesh::film_dof_normals(to.films, to.topology);
  for (std::size_t d = 0; d < footprint.point.size(); ++d) {
    const int lamella = to.lamella_of_dof[d];
    if (linked[lamella] || !(to.lamella_area[lamella] > 0)) continue;
    const auto& own = to.topology.lamella[lamella];
    footprint.point[d] = locator.closest(to.film_position(static_cast<int>(d)), reach, [&](int t) {
      const Triangle& triangle = from.films.triangle[t];
      const bool shares_phase = triangle.phase_a == own.phase_a || triangle.phase_a == own.phase_b ||
                                triangle.phase_b == own.phase_a || triangle.phase_b == own.phase_b;
      return shares_phase &&
             std::abs(dot(normalized(mesh::doubled_area_normal(from.films, t)), normals[d])) > parallel;
    });
    const int t = footprint.point[d].triangle;
    if (t >= 0) footprint.same.emplace_back(from.topology.triangle_lamella[t], lamella);
  }
}

/// η at the new dofs of linked lamellae. A dof far from the old film takes the mean of its lamella.
std::vector<double> interpolate(const HalfThickness& eta, const LiquidMesh& to, const Footprint& footprint,
                                const Links& links) {
  std::vector<double> value(footprint.point.size(), 0);
  for (int l = 0; l < to.topology.n_lamellae(); ++l) {
    if (links.group_of_new[l] < 0) continue;
    double sum = 0, area = 0;
    for (int d : to.dofs_of_lamella[l]) {
      if (footprint.point[d].triangle < 0) continue;
      value[d] = eta.at(footprint.point[d]);
      sum += value[d] * to.dof_area[d];
      area += to.dof_area[d];
    }
    for (int d : to.dofs_of_lamella[l])
      if (footprint.point[d].triangle < 0 && area > 0) value[d] = sum / area;
  }
  return value;
}

void report_rescaling(const Links& links, const std::vector<double>& factor, const LiquidMesh& to,
                      double small_area, TransferReport& report) {
  std::vector<double> group_area(links.n_groups, 0);
  for (int l = 0; l < to.topology.n_lamellae(); ++l)
    if (links.group_of_new[l] >= 0) group_area[links.group_of_new[l]] += to.lamella_area[l];
  for (int g = 0; g < links.n_groups; ++g) {
    if (group_area[g] <= small_area) continue;
    report.smallest_rescaling = std::min(report.smallest_rescaling, factor[g]);
    report.largest_rescaling = std::max(report.largest_rescaling, factor[g]);
  }
}

}  // namespace

FilmTransfer transfer_films(const parallel::Communicator& ranks, const LiquidMesh& from,
                            std::span<const double> old_volume, const LiquidMesh& to, double h,
                            const TransportParameters& parameters, TransferReport& report) {
  const mesh::TriangleLocator locator(from.films, h);
  Footprint footprint;
  footprint.point.resize(to.topology.film_dof.size());
  find_own_pairs(ranks, from, locator, to, parameters.reach * h, footprint);
  find_renamed(from, locator, to, parameters.reach * h, footprint);

  FilmTransfer transfer;
  transfer.links = link_pieces(from.topology.n_lamellae(), to.topology.n_lamellae(), footprint.same);
  transfer.volume = interpolate(HalfThickness(from, old_volume, h), to, footprint, transfer.links);
  for (std::size_t d = 0; d < transfer.volume.size(); ++d) transfer.volume[d] *= 2 * to.dof_area[d];
  const std::vector<double> factor =
      rescale_groups(transfer.links, {from.lamella_of_dof, from.dof_area}, old_volume,
                     {to.lamella_of_dof, to.dof_area}, transfer.volume);
  report_rescaling(transfer.links, factor, to, parameters.small_area * h * h, report);
  return transfer;
}

}  // namespace spume::transport
