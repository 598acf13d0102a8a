#include "spume/verification/four_bubble_films.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "spume/base/contract.hpp"
#include "spume/verification/exact_clusters.hpp"
#include "spume/verification/film_networks.hpp"

namespace spume::verification {

namespace {

constexpr int n_bubbles = 4;

/// Centres of the spheres of radius 1; bubble b of 0, …, 3 is phase b + 1.
std::array<Vec3, n_bubbles> centres() {
  const double r = 1 / std::sqrt(3.0), z = 1 / std::sqrt(24.0);
  return {Vec3{r, 0, -z}, Vec3{-r / 2, 0.5, -z}, Vec3{-r / 2, -0.5, -z}, Vec3{0, 0, 3 * z}};
}

/// Builds the mesh of the cluster of radius 1.
class Builder {
 public:
  explicit Builder(double spacing)
      : centre_(centres()),
        exact_(equal_cluster(n_bubbles)),
        n_inner_(std::max(2, static_cast<int>(std::lround(exact_.inner_border / spacing)))),
        n_outer_(std::max(3, static_cast<int>(std::lround(exact_.outer_border / spacing)))) {
    origin_ = add({0, 0, 0});
    for (int b = 0; b < n_bubbles; ++b) inner_[b] = inner_border(b);
    for (int c = 0; c < n_bubbles; ++c)
      for (int d = c + 1; d < n_bubbles; ++d) outer_[{c, d}] = outer_border(c, d);
    for (int a = 0; a < n_bubbles; ++a) {
      add_cap(a);
      for (int b = a + 1; b < n_bubbles; ++b) add_flat_film(a, b);
    }
  }

  mesh::FilmMesh films() { return std::move(mesh_); }

 private:
  int add(const Vec3& x) {
    mesh_.position.push_back(x);
    return mesh_.n_vertices() - 1;
  }
  const Vec3& at(int v) const { return mesh_.position[v]; }
  Vec3 junction(int opposite) const { return -exact_.outer_junction * normalized(centre_[opposite]); }

  /// From the middle to the junction opposite to a bubble.
  std::vector<int> inner_border(int opposite) {
    std::vector<int> line{origin_};
    for (int k = 1; k <= n_inner_; ++k)
      line.push_back(add((static_cast<double>(k) / n_inner_) * junction(opposite)));
    return line;
  }

  /// Along the circle between the other two bubbles, from the junction opposite to c to that opposite to d.
  std::vector<int> outer_border(int c, int d) {
    Vec3 middle;
    for (int b = 0; b < n_bubbles; ++b)
      if (b != c && b != d) middle += 0.5 * centre_[b];
    const Vec3 from = junction(c) - middle, to = junction(d) - middle, top = normalized(from + to);
    const double half = std::acos(dot(from, top) / norm(from));
    const Vec3 side = normalized(to - from);
    std::vector<int> line{inner_[c].back()};
    for (int k = 1; k < n_outer_; ++k) {
      const double angle = half * (2.0 * k / n_outer_ - 1);
      line.push_back(add(middle + norm(from) * (std::cos(angle) * top + std::sin(angle) * side)));
    }
    line.push_back(inner_[d].back());
    return line;
  }

  /// Along the outer border, in the direction asked for.
  std::vector<int> outer(int from, int to) const {
    std::vector<int> line = outer_.at(std::minmax(from, to));
    if (from > to) std::ranges::reverse(line);
    return line;
  }
  /// The point of an outer border at a share s of its length.
  Vec3 on_outer(const std::vector<int>& line, double s) const {
    const double k = s * n_outer_;
    const int first = std::min(static_cast<int>(k), n_outer_ - 1);
    return at(line[first]) + (k - first) * (at(line[first + 1]) - at(line[first]));
  }

  /// Rows from the middle of the cluster to the outer border, straight at first and then more and more round.
  void add_flat_film(int a, int b) {
    std::array<int, 2> other{};
    for (int c = 0, n = 0; c < n_bubbles; ++c)
      if (c != a && c != b) other[n++] = c;
    const auto [c, d] = other;
    const std::vector<int> arc = outer(c, d);
    const Vec3 u = junction(c), v = junction(d);
    const double opening = norm(u - v) / exact_.inner_border;
    const bool from_a = dot(cross(u, v), centre_[b] - centre_[a]) > 0;
    const mesh::Phase p = 1 + (from_a ? a : b), q = 1 + (from_a ? b : a);
    std::vector<int> near{origin_};
    for (int row = 1; row <= n_inner_; ++row) {
      const double t = static_cast<double>(row) / n_inner_;
      const double length = row * ((1 - t) * opening + t * n_outer_ / n_inner_);
      const int pieces = row == n_inner_ ? n_outer_ : row == 1 ? 1 : static_cast<int>(std::lround(length));
      std::vector<int> far{inner_[c][row]};
      for (int j = 1; j < pieces; ++j) {
        const double s = static_cast<double>(j) / pieces;
        far.push_back(row == n_inner_ ? arc[j]
                                      : add(t * ((1 - t) * ((1 - s) * u + s * v) + t * on_outer(arc, s))));
      }
      far.push_back(inner_[d][row]);
      add_band(mesh_, near, far, p, q);
      near = std::move(far);
    }
  }

  /// A triangle in each corner, and then loops that shrink from the borders to the pole of the sphere and
  /// become round.
  void add_cap(int a) {
    const Vec3 up = normalized(centre_[a]);
    std::vector<int> loop = loop_around(a, up);
    const mesh::Phase bubble = 1 + a;
    std::vector<int> near;  // the loop without its corners, closed
    for (std::size_t j = 0; j + 1 < loop.size(); ++j) {
      if (j % n_outer_ != 0) {
        near.push_back(loop[j]);
        continue;
      }
      const int before = loop[j == 0 ? loop.size() - 2 : j - 1];
      mesh_.triangle.push_back(mesh::make_triangle(before, loop[j], loop[j + 1], bubble, 0));
    }
    near.push_back(near.front());
    double mean = 0;  // polar angle of the border
    for (std::size_t j = 0; j + 1 < loop.size(); ++j) mean += polar_angle(loop[j], a, up) / (3 * n_outer_);
    const int rows = std::max(2, static_cast<int>(std::lround(1.1 * mean * n_outer_ / exact_.outer_border)));
    for (int row = 1; row <= rows; ++row) {
      const double t = 1 - static_cast<double>(row) / rows;
      const int pieces =
          std::max(6, static_cast<int>(std::lround(3 * n_outer_ * std::sin(t * mean) / std::sin(mean))));
      std::vector<int> far;
      if (row == rows) {
        far.push_back(add(centre_[a] + up));
      } else {
        for (int j = 0; j < pieces; ++j) {
          const Vec3 r = on_loop(loop, 3.0 * n_outer_ * (j + 0.5 * (row % 2)) / pieces) - centre_[a];
          const Vec3 side = normalized(r - dot(r, up) * up);
          const double border = std::acos(dot(r, up) / norm(r)), angle = t * (t * border + (1 - t) * mean);
          far.push_back(add(centre_[a] + std::cos(angle) * up + std::sin(angle) * side));
        }
        far.push_back(far.front());
      }
      add_band(mesh_, far, near, bubble, 0);
      near = std::move(far);
    }
  }
  /// The three borders of a cap, against the clock as seen from outside, the first vertex repeated at the
  /// end.
  std::vector<int> loop_around(int a, const Vec3& up) const {
    std::array<int, 3> corner{};
    for (int c = 0, n = 0; c < n_bubbles; ++c)
      if (c != a) corner[n++] = c;
    const Vec3 x = junction(corner[0]), y = junction(corner[1]), z = junction(corner[2]);
    if (dot(cross(y - x, z - x), up) < 0) std::swap(corner[1], corner[2]);
    std::vector<int> loop;
    for (int c = 0; c < 3; ++c) {
      const std::vector<int> side = outer(corner[c], corner[(c + 1) % 3]);
      loop.insert(loop.end(), side.begin(), side.end() - 1);
    }
    loop.push_back(loop.front());
    return loop;
  }
  Vec3 on_loop(const std::vector<int>& loop, double k) const {
    const auto first = std::min(static_cast<std::size_t>(k), loop.size() - 2);
    return at(loop[first]) + (k - static_cast<double>(first)) * (at(loop[first + 1]) - at(loop[first]));
  }
  double polar_angle(int v, int a, const Vec3& up) const { return std::acos(dot(at(v) - centre_[a], up)); }

  mesh::FilmMesh mesh_;
  std::array<Vec3, n_bubbles> centre_;
  EqualCluster exact_;
  int n_inner_, n_outer_;  ///< edges of a border
  int origin_ = 0;
  std::array<std::vector<int>, n_bubbles> inner_;
  std::map<std::pair<int, int>, std::vector<int>> outer_;
};

}  // namespace

mesh::FilmMesh four_bubble_films(double radius, double spacing) {
  expects(0 < spacing && spacing < radius, "edges shorter than the radius");
  mesh::FilmMesh films = Builder(spacing / radius).films();
  for (Vec3& x : films.position) x *= radius;
  return films;
}

Middle four_bubble_middle(double radius) {
  return [radius, centre = centres()](const Vec3& a, const Vec3& b, const mesh::PhaseSet& phases) {
    const Vec3 x = 0.5 * (a + b);
    if (!phases.contains(0)) return x;  // plane films and straight borders
    // A border on the outside lies on a circle about the middle of two centres, a film on a sphere.
    Vec3 c;
    for (mesh::Phase p : phases)
      if (p > 0) c += radius / (phases.size() - 1) * centre[p - 1];
    const double r = phases.size() == 2 ? radius : std::sqrt(0.75) * radius;
    return c + r * normalized(x - c);
  };
}

state::FilmNetwork four_bubble_network(mesh::FilmMesh films, double radius) {
  auto network = uniform_network(std::move(films), 5e-6, 5e-8);
  for (std::size_t d = 0; d < network.curvature_squared.size(); ++d)
    if (network.topology.lamella[network.topology.film_dof[d].lamella].phase_a == 0)
      network.curvature_squared[d] = 2 / (radius * radius);
  return network;
}

}  // namespace spume::verification
