#include "spume/io/rasterize.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "spume/mesh/locate.hpp"

namespace spume::io {

namespace {

/// Triangles reach this far beyond the box from a corner in it.
constexpr double margin_cells = 4;

/// Where a row of cell centres goes through a film.
struct Crossing {
  double x;                    ///< [m]
  mesh::Phase before, behind;  ///< going up x
};

/// How often the edge a→b, projected along x, passes the point (y, z) on its right: +1 upwards, −1 downwards.
/// The two triangles of an edge get opposite numbers from the same arithmetic, so the counts of a closed
/// surface cancel exactly.
int passes(Vec3 a, Vec3 b, int index_a, int index_b, double y, double z) {
  const bool a_above = a.z > z, b_above = b.z > z;
  if (a_above == b_above) return 0;
  if (index_a > index_b) std::swap(a, b);
  const double area = (b.y - a.y) * (z - a.z) - (b.z - a.z) * (y - a.y);
  const bool right_of_point = (b.z > a.z) ? area > 0 : area < 0;
  if (!right_of_point) return 0;
  return b_above ? 1 : -1;
}

/// x at which the plane of a triangle meets the line (y, z), kept within the triangle's own range.
double meeting(const Vec3& a, const Vec3& b, const Vec3& c, double y, double z) {
  const Vec3 n = cross(b - a, c - a);
  const double lowest = std::min({a.x, b.x, c.x}), highest = std::max({a.x, b.x, c.x});
  const double x = a.x - (n.y * (y - a.y) + n.z * (z - a.z)) / n.x;
  return std::isfinite(x) ? std::clamp(x, lowest, highest) : 0.5 * (lowest + highest);
}

struct Range {
  int begin, end;
};

/// Cells whose centres lie in [low, high] along an axis, and `more` on either side.
Range cells_between(double low, double high, double lower, double h, int n, int more) {
  const auto nearest = [&](double x) { return std::clamp((x - lower) / h - 0.5, -1.0, n + 0.0); };
  return {std::max(0, static_cast<int>(std::ceil(nearest(low))) - more),
          std::min(n, static_cast<int>(std::floor(nearest(high))) + 1 + more)};
}

Range cells_around(const std::array<Vec3, 3>& corner, const grid::Box& box, int axis, int more) {
  const auto at = [&](int c) { return corner[c][axis]; };
  return cells_between(std::min({at(0), at(1), at(2)}), std::max({at(0), at(1), at(2)}), box.lower[axis],
                       box.spacing(), box.cells[axis], more);
}

/// Calls body(corner) for the images of a triangle in the box and near it. An image of a vertex has the same
/// coordinates, to the last bit, in every triangle.
template <class Body>
void for_each_image(const mesh::FilmMesh& films, const mesh::FilmTriangle& t, double margin, Body&& body) {
  const auto& x = films.position;
  films.domain.for_each_image(x[t.vertex[0]], margin, [&](const Vec3& first) {
    const Vec3 a = films.domain.near(x[t.vertex[0]], first), b = films.domain.near(x[t.vertex[1]], a),
               c = films.domain.near(x[t.vertex[2]], a);
    body(std::array<Vec3, 3>{a, b, c});
  });
}

std::vector<std::vector<Crossing>> find_crossings(const mesh::FilmMesh& films, const grid::Box& box) {
  std::vector<std::vector<Crossing>> crossings(static_cast<std::size_t>(box.cells.j) * box.cells.k);
  const double h = box.spacing();
  for (const auto& t : films.triangle) {
    for_each_image(films, t, margin_cells * h, [&](const std::array<Vec3, 3>& corner) {
      const Range js = cells_around(corner, box, 1, 1), ks = cells_around(corner, box, 2, 1);
      for (int k = ks.begin; k < ks.end; ++k)
        for (int j = js.begin; j < js.end; ++j) {
          const double y = box.lower.y + (j + 0.5) * h, z = box.lower.z + (k + 0.5) * h;
          int winding = 0;
          for (int e = 0; e < 3; ++e)
            winding += passes(corner[e], corner[(e + 1) % 3], t.vertex[e], t.vertex[(e + 1) % 3], y, z);
          if (winding == 0) continue;
          // Counter-clockwise in (y, z) means that the normal, from phase_a into phase_b, points up x.
          const double x = meeting(corner[0], corner[1], corner[2], y, z);
          auto& row = crossings[static_cast<std::size_t>(k) * box.cells.j + j];
          if (winding > 0)
            row.push_back({x, t.phase_a, t.phase_b});
          else
            row.push_back({x, t.phase_b, t.phase_a});
        }
    });
  }
  return crossings;
}

/// The phase of a row of cells that no film crosses: in a periodic box it may be any. Seen from the nearest
/// films of three of its points.
mesh::Phase phase_of_free_row(const mesh::FilmMesh& films, const mesh::TriangleLocator& locator,
                              const grid::Box& box, int j, int k) {
  if (!films.domain.is_periodic() || films.triangle.empty()) return 0;
  std::array<mesh::Phase, 3> seen;
  for (int m = 0; m < 3; ++m) {
    const Vec3 x = box.lower + box.spacing() * Vec3{box.cells.i * (m + 0.5) / 3, j + 0.5, k + 0.5};
    const auto near = locator.closest(x, norm(box.size()), {});
    const auto [a, b, c] = films.corners(near.triangle);
    const Vec3 foot = near.weight[0] * a + near.weight[1] * b + near.weight[2] * c;
    const auto& t = films.triangle[near.triangle];
    const bool behind = dot(films.domain.step(foot, x), mesh::doubled_area_normal(films, near.triangle)) > 0;
    seen[m] = behind ? t.phase_b : t.phase_a;
  }
  return seen[1] == seen[2] ? seen[1] : seen[0];
}

}  // namespace

std::vector<mesh::Phase> rasterize_phases(const mesh::FilmMesh& films, int n_phases, const grid::Box& box) {
  const double h = box.spacing();
  std::vector<mesh::Phase> phase_of_cell;
  phase_of_cell.reserve(static_cast<std::size_t>(box.cells.i) * box.cells.j * box.cells.k);
  std::vector<int> inside(n_phases);  // how often the row has entered each phase, less how often it left it
  const mesh::TriangleLocator locator(films, 4 * h);
  int n_rows = 0;
  for (auto& row : find_crossings(films, box)) {
    std::stable_sort(row.begin(), row.end(), [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    std::fill(inside.begin(), inside.end(), 0);
    mesh::Phase here =
        row.empty() ? phase_of_free_row(films, locator, box, n_rows % box.cells.j, n_rows / box.cells.j)
                    : row.front().before;
    ++n_rows;
    inside[here] = 1;
    auto next = row.begin();
    for (int i = 0; i < box.cells.i; ++i) {
      const auto passed = next;
      for (const double x = box.lower.x + (i + 0.5) * h; next != row.end() && next->x < x; ++next) {
        --inside[next->before];
        ++inside[next->behind];
      }
      // Where films lie closer than round-off their order is not certain; the counts are.
      for (auto crossing = passed; crossing != next && inside[here] < 1; ++crossing) here = crossing->behind;
      phase_of_cell.push_back(here);
    }
  }
  return phase_of_cell;
}

namespace {

/// Cells with the nearest triangle found so far.
class NearestTriangles {
 public:
  NearestTriangles(const mesh::FilmMesh& films, const grid::Box& box, double largest_value)
      : films_(films),
        box_(box),
        n_(box.cells),
        h_(box.spacing()),
        nearest_(total(), -1),
        distance_(total(), largest_value) {}

  void try_triangle(int i, int j, int k, int triangle) {
    const std::size_t c = cell(i, j, k);
    if (triangle < 0 || triangle == nearest_[c]) return;
    const Vec3 x = box_.lower + h_ * Vec3{i + 0.5, j + 0.5, k + 0.5};
    const auto [p, q, r] = films_.corners(triangle);
    const Vec3 shift = films_.domain.near(p, x) - p;
    std::array<double, 3> weight;
    const double d = std::sqrt(mesh::closest_point_on_triangle(x, p + shift, q + shift, r + shift, weight));
    if (nearest_[c] >= 0 && d >= distance_[c]) return;
    nearest_[c] = triangle;
    distance_[c] = d;
  }

  /// Each cell tries the triangles of its three neighbours on the side where the sweep comes from.
  void sweep(bool up_x, bool up_y, bool up_z) {
    const int di = up_x ? -1 : 1, dj = up_y ? -1 : 1, dk = up_z ? -1 : 1;
    const auto at = [](int step, int n, bool up) { return up ? step : n - 1 - step; };
    for (int c = 0; c < n_.k; ++c)
      for (int b = 0; b < n_.j; ++b)
        for (int a = 0; a < n_.i; ++a) {
          const int i = at(a, n_.i, up_x), j = at(b, n_.j, up_y), k = at(c, n_.k, up_z);
          if (a > 0) try_triangle(i, j, k, nearest_[cell(i + di, j, k)]);
          if (b > 0) try_triangle(i, j, k, nearest_[cell(i, j + dj, k)]);
          if (c > 0) try_triangle(i, j, k, nearest_[cell(i, j, k + dk)]);
        }
  }

  std::vector<double> take_distance() { return std::move(distance_); }

 private:
  std::size_t total() const { return static_cast<std::size_t>(n_.i) * n_.j * n_.k; }
  std::size_t cell(int i, int j, int k) const { return (static_cast<std::size_t>(k) * n_.j + j) * n_.i + i; }

  const mesh::FilmMesh& films_;
  grid::Box box_;
  Index3 n_;
  double h_;
  std::vector<int> nearest_;
  std::vector<double> distance_;
};

}  // namespace

std::vector<double> rasterize_distance(const mesh::FilmMesh& films, const grid::Box& box,
                                       double largest_value) {
  NearestTriangles nearest(films, box, largest_value);
  for (int t = 0; t < films.n_triangles(); ++t) {
    for_each_image(films, films.triangle[t], margin_cells * box.spacing(), [&](const auto& corner) {
      const Range is = cells_around(corner, box, 0, 1), js = cells_around(corner, box, 1, 1),
                  ks = cells_around(corner, box, 2, 1);
      for (int k = ks.begin; k < ks.end; ++k)
        for (int j = js.begin; j < js.end; ++j)
          for (int i = is.begin; i < is.end; ++i) nearest.try_triangle(i, j, k, t);
    });
  }
  for (int order = 0; order < 8; ++order) nearest.sweep((order & 1) == 0, (order & 2) == 0, (order & 4) == 0);
  return nearest.take_distance();
}

}  // namespace spume::io
