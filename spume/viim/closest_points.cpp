#include "spume/viim/closest_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spume/interface/cell_box.hpp"
#include "spume/mesh/locate.hpp"

namespace spume::viim {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The triangles at each vertex.
struct Stars {
  std::vector<int> offset, triangle;

  explicit Stars(const mesh::FilmMesh& surface) : offset(surface.n_vertices() + 1, 0) {
    for (const auto& t : surface.triangle)
      for (int v : t.vertex) ++offset[v + 1];
    for (std::size_t v = 1; v < offset.size(); ++v) offset[v] += offset[v - 1];
    triangle.resize(offset.back());
    std::vector<int> end(offset.begin(), offset.end() - 1);
    for (int t = 0; t < surface.n_triangles(); ++t)
      for (int v : surface.triangle[t].vertex) triangle[end[v]++] = t;
  }
};

/// Holds a triangle.
struct Ball {
  Vec3 centre;
  double radius;
};

std::vector<Ball> balls_around(const mesh::FilmMesh& surface) {
  std::vector<Ball> balls;
  balls.reserve(surface.triangle.size());
  for (const auto& t : surface.triangle) {
    Ball ball{{}, 0};
    for (int v : t.vertex) ball.centre += surface.position[v] / 3;
    for (int v : t.vertex) ball.radius = std::max(ball.radius, norm(surface.position[v] - ball.centre));
    balls.push_back(ball);
  }
  return balls;
}

class Search {
 public:
  Search(const mesh::FilmMesh& surface, const grid::Box& box, double reach, const std::vector<bool>& wanted)
      : surface_(surface),
        box_(box),
        h_(box.spacing()),
        whole_(interface::all_cells(box.cells)),
        ball_(balls_around(surface)),
        nearest_(whole_.size(), -1),
        squared_(whole_.size(), std::nextafter(reach * reach, infinite)) {
    for (std::size_t c = 0; c < wanted.size(); ++c)
      if (!wanted[c]) squared_[c] = -1;  // nothing is nearer
  }

  std::vector<ClosestPoint> run() {
    seed();
    propagate();
    return walk();
  }

 private:
  Vec3 centre(int i, int j, int k) const { return box_.lower + h_ * Vec3{i + 0.5, j + 0.5, k + 0.5}; }

  double squared_distance(const Vec3& x, int triangle, std::array<double, 3>& weight) const {
    const auto& v = surface_.triangle[triangle].vertex;
    return mesh::closest_point_on_triangle(x, surface_.position[v[0]], surface_.position[v[1]],
                                           surface_.position[v[2]], weight);
  }

  bool improve(int i, int j, int k, int triangle) {
    const std::size_t cell = whole_.offset(i, j, k);
    if (triangle == nearest_[cell] || squared_[cell] < 0) return false;
    const Vec3 x = centre(i, j, k);
    const Ball& ball = ball_[triangle];
    const double beyond_ball = std::sqrt(squared_[cell]) + ball.radius;
    if (norm_squared(x - ball.centre) > beyond_ball * beyond_ball) return false;
    std::array<double, 3> weight;
    const double d2 = squared_distance(x, triangle, weight);
    if (!(d2 < squared_[cell])) return false;
    nearest_[cell] = triangle;
    squared_[cell] = d2;
    return true;
  }

  /// Every triangle is tried by the cells within half a cell of its bounding box, of which there is one at
  /// least.
  void seed() {
    for (int t = 0; t < surface_.n_triangles(); ++t) {
      interface::CellBox cells;
      for (int d = 0; d < 3; ++d) {
        double low = infinite, high = -infinite;
        for (int v : surface_.triangle[t].vertex) {
          const double place = (surface_.position[v][d] - box_.lower[d]) / h_ - 0.5;
          low = std::min(low, place);
          high = std::max(high, place);
        }
        cells.begin[d] = std::max(0, static_cast<int>(std::ceil(low - 0.5)));
        cells.end[d] = std::min(box_.cells[d], static_cast<int>(std::floor(high + 0.5)) + 1);
      }
      interface::for_each_cell(cells, [&](int i, int j, int k) { improve(i, j, k, t); });
    }
  }

  void propagate() {
    std::vector<Index3> front, next;
    std::vector<bool> queued(whole_.size(), false);
    interface::for_each_cell(whole_, [&](int i, int j, int k) {
      if (nearest_[whole_.offset(i, j, k)] >= 0) front.push_back({i, j, k});
    });
    for (; !front.empty(); std::swap(front, next)) {
      next.clear();
      for (const Index3& c : front) queued[whole_.offset(c.i, c.j, c.k)] = false;
      for (const Index3& c : front) {
        const int triangle = nearest_[whole_.offset(c.i, c.j, c.k)];
        const interface::CellBox around = interface::Lattice {
          box_.cells
        }.grown({c, {c.i + 1, c.j + 1, c.k + 1}}, 1);
        interface::for_each_cell(around, [&](int i, int j, int k) {
          if (!improve(i, j, k, triangle)) return;
          const std::size_t cell = whole_.offset(i, j, k);
          if (!queued[cell]) next.push_back({i, j, k});
          queued[cell] = true;
        });
      }
    }
  }

  std::vector<ClosestPoint> walk() const {
    const Stars stars(surface_);
    std::vector<ClosestPoint> found;
    interface::for_each_cell(whole_, [&](int i, int j, int k) {
      const std::size_t cell = whole_.offset(i, j, k);
      if (nearest_[cell] < 0) return;
      ClosestPoint p{cell, centre(i, j, k), nearest_[cell], {}, {}, 0};
      double best = squared_distance(p.centre, p.triangle, p.weight);
      for (bool better = true; better;) {
        better = false;
        if (*std::min_element(p.weight.begin(), p.weight.end()) > 0) break;
        const auto vertices = surface_.triangle[p.triangle].vertex;
        for (int corner = 0; corner < 3 && !better; ++corner) {
          if (p.weight[corner] == 0) continue;
          const int v = vertices[corner];
          for (int n = stars.offset[v]; n < stars.offset[v + 1]; ++n) {
            std::array<double, 3> weight;
            const double d2 = squared_distance(p.centre, stars.triangle[n], weight);
            if (!(d2 < best)) continue;
            best = d2;
            p.triangle = stars.triangle[n];
            p.weight = weight;
            better = true;
          }
        }
      }
      const auto& v = surface_.triangle[p.triangle].vertex;
      for (int c = 0; c < 3; ++c) p.point += p.weight[c] * surface_.position[v[c]];
      p.distance = std::sqrt(best);
      found.push_back(p);
    });
    return found;
  }

  const mesh::FilmMesh& surface_;
  grid::Box box_;
  double h_;
  interface::CellBox whole_;
  std::vector<Ball> ball_;
  std::vector<int> nearest_;
  std::vector<double> squared_;  ///< distance below which a triangle is taken
};

}  // namespace

std::vector<ClosestPoint> closest_points(const mesh::FilmMesh& surface, const grid::Box& box, double reach,
                                         const std::vector<bool>& wanted) {
  return Search(surface, box, reach, wanted).run();
}

}  // namespace spume::viim
