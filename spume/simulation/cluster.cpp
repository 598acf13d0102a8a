#include "spume/simulation/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spume/base/random.hpp"

namespace spume::simulation {

namespace {

std::vector<BubbleShape> scattered(const ClusterShape& cluster) {
  Random random(cluster.seed);
  const double radius = 0.5 * cluster.mean_diameter;
  const double room = 1.6 * radius * std::cbrt(cluster.count);
  std::vector<BubbleShape> bubbles(cluster.count);
  for (auto& bubble : bubbles) {
    const double r = radius * (1 + cluster.spread * std::clamp(random.normal(), -2.0, 2.0));
    bubble.semi_axes = {r, r, r};
    for (int d = 0; d < 3; ++d) bubble.center[d] = random.uniform(-room, room);
  }
  return bubbles;
}

void draw_together(std::vector<BubbleShape>& bubbles) {
  constexpr double overlap = 0.8, pull = 0.02, push = 0.4, relaxation = 0.3;
  constexpr int sweeps = 4000;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::vector<Vec3> move(bubbles.size());
    for (std::size_t a = 0; a < bubbles.size(); ++a) {
      move[a] -= pull * bubbles[a].center;
      for (std::size_t b = 0; b < bubbles.size(); ++b) {
        if (a == b) continue;
        const Vec3 apart = bubbles[a].center - bubbles[b].center;
        const double distance = norm(apart);
        const double too_near = overlap * (bubbles[a].semi_axes.x + bubbles[b].semi_axes.x) - distance;
        if (too_near > 0) move[a] += (push * too_near) * normalized(apart);
      }
    }
    for (std::size_t a = 0; a < bubbles.size(); ++a) bubbles[a].center += relaxation * move[a];
  }
}

bool inside_any(const std::vector<BubbleShape>& bubbles, const Vec3& x, double radius) {
  return std::any_of(bubbles.begin(), bubbles.end(),
                     [&](const BubbleShape& bubble) { return power_potential(bubble, x, radius) > 0; });
}

/// A box of cubic cells about the cluster, fine enough to measure the volume of its union, pockets included.
grid::Box measuring_box(const std::vector<BubbleShape>& bubbles) {
  double reach = 0;
  for (const auto& bubble : bubbles) reach = std::max(reach, norm(bubble.center) + bubble.semi_axes.x);
  const int n = 96;
  reach *= 1.05;
  return {{-reach, -reach, -reach}, {reach, reach, reach}, {n, n, n}};
}

double union_volume(const std::vector<BubbleShape>& bubbles) {
  const grid::Box box = measuring_box(bubbles);
  const auto pocket = enclosed_pockets(bubbles, box);
  const double radius = mean_radius(bubbles), h = box.spacing();
  std::size_t cell = 0, n_inside = 0;
  for (int k = 0; k < box.cells.k; ++k)
    for (int j = 0; j < box.cells.j; ++j)
      for (int i = 0; i < box.cells.i; ++i, ++cell)
        n_inside +=
            pocket[cell] || inside_any(bubbles, box.lower + h * Vec3{i + 0.5, j + 0.5, k + 0.5}, radius);
  return static_cast<double>(n_inside) * h * h * h;
}

}  // namespace

double equivalent_radius(const BubbleShape& bubble) {
  return std::cbrt(bubble.semi_axes.x * bubble.semi_axes.y * bubble.semi_axes.z);
}

double mean_radius(const std::vector<BubbleShape>& bubbles) {
  double sum = 0;
  for (const auto& bubble : bubbles) sum += equivalent_radius(bubble);
  return sum / static_cast<double>(bubbles.size());
}

double power_potential(const BubbleShape& bubble, const Vec3& x, double mean_radius) {
  const Vec3 d = x - bubble.center;
  const double radius = equivalent_radius(bubble);
  double s = 0;
  for (int axis = 0; axis < 3; ++axis)
    s += d[axis] * d[axis] / (bubble.semi_axes[axis] * bubble.semi_axes[axis]);
  return radius * radius / (2 * mean_radius) * (1 - s);
}

std::vector<BubbleShape> make_cluster(const ClusterShape& cluster, const grid::Box& box) {
  std::vector<BubbleShape> bubbles = scattered(cluster);
  draw_together(bubbles);

  double wanted = 0;
  for (const auto& bubble : bubbles) wanted += 4 * std::numbers::pi / 3 * std::pow(bubble.semi_axes.x, 3);
  const double scale = std::cbrt(wanted / union_volume(bubbles));
  Vec3 centroid;
  for (const auto& bubble : bubbles) centroid += bubble.center / static_cast<double>(bubbles.size());
  const Vec3 middle = cluster.center.value_or(0.5 * (box.lower + box.upper));
  for (auto& bubble : bubbles) {
    bubble.center = middle + scale * (bubble.center - centroid);
    bubble.semi_axes *= scale;
  }
  return bubbles;
}

std::vector<char> enclosed_pockets(const std::vector<BubbleShape>& bubbles, const grid::Box& box) {
  const Index3 n = box.cells;
  const double h = box.spacing(), radius = mean_radius(bubbles);
  const auto index = [&](int i, int j, int k) { return (static_cast<std::size_t>(k) * n.j + j) * n.i + i; };
  std::vector<char> is_pocket(index(0, 0, n.k), 0);
  for (int k = 0; k < n.k; ++k)
    for (int j = 0; j < n.j; ++j)
      for (int i = 0; i < n.i; ++i)
        is_pocket[index(i, j, k)] =
            !inside_any(bubbles, box.lower + h * Vec3{i + 0.5, j + 0.5, k + 0.5}, radius);

  // Whatever can be reached from the edge of the box is no pocket.
  std::vector<Index3> reached;
  const auto reach = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || k < 0 || i >= n.i || j >= n.j || k >= n.k || !is_pocket[index(i, j, k)]) return;
    is_pocket[index(i, j, k)] = 0;
    reached.push_back({i, j, k});
  };
  for (int k = 0; k < n.k; ++k)
    for (int j = 0; j < n.j; ++j)
      for (int i = 0; i < n.i; ++i)
        if (i == 0 || j == 0 || k == 0 || i == n.i - 1 || j == n.j - 1 || k == n.k - 1) reach(i, j, k);
  while (!reached.empty()) {
    const Index3 c = reached.back();
    reached.pop_back();
    // Corner neighbours count: a cusp between spheres is no pocket because its last cell touches the rest at
    // a corner.
    for (int dk = -1; dk <= 1; ++dk)
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) reach(c.i + di, c.j + dj, c.k + dk);
  }
  return is_pocket;
}

}  // namespace spume::simulation
