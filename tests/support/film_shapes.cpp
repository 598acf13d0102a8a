#include "tests/support/film_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "spume/base/contract.hpp"

namespace spume::shapes {
namespace {

using mesh::FilmMesh;
using mesh::make_triangle;
using mesh::Phase;
using mesh::PhaseSet;
using std::numbers::pi;

/// Vertices on a circle around the x axis, at angles 2π n / count; one vertex is a point on the axis.
struct Ring {
  int first, count;
};

Ring add_ring(FilmMesh& mesh, double x, double radius, int count) {
  const Ring ring{mesh.n_vertices(), count};
  for (int n = 0; n < count; ++n)
    mesh.position.push_back(
        {x, radius * std::cos(2 * pi * n / count), radius * std::sin(2 * pi * n / count)});
  return ring;
}

/// Triangles between two rings, with normals towards +x, from p into q, when the inner one is nearer the
/// axis.
void stitch(FilmMesh& mesh, const Ring& inner, const Ring& outer, Phase p, Phase q) {
  const int n_inner = inner.count == 1 ? 0 : inner.count;
  const auto vertex = [](const Ring& ring, int n) { return ring.first + n % ring.count; };
  for (int i = 0, j = 0; i < n_inner || j < outer.count;) {
    const bool outwards = i == n_inner || (j < outer.count && (j + 1) * n_inner <= (i + 1) * outer.count);
    if (outwards) {
      mesh.triangle.push_back(make_triangle(vertex(inner, i), vertex(outer, j), vertex(outer, j + 1), p, q));
      ++j;
    } else {
      mesh.triangle.push_back(make_triangle(vertex(inner, i), vertex(outer, j), vertex(inner, i + 1), p, q));
      ++i;
    }
  }
}

/// The spherical cap from its pole to the ring of a double bubble, on the side of x of the given sign.
void add_cap(FilmMesh& mesh, double radius, double sign, const Ring& rim, Phase p, Phase q) {
  const double opening = 2 * pi / 3;  // polar angle of the ring
  const double edge = std::sqrt(3.0) * pi * radius / rim.count;
  const int n_rings = static_cast<int>(std::lround(opening * radius / (0.9 * edge)));
  const auto add = [&](int k) {
    const double angle = opening * k / n_rings;
    const double circle = radius * std::sin(angle);
    const int count = k == 0 ? 1 : std::max(5, static_cast<int>(std::lround(2 * pi * circle / edge)));
    return add_ring(mesh, sign * radius * (0.5 + std::cos(angle)), circle, count);
  };
  Ring inner = add(0);
  for (int k = 1; k <= n_rings; ++k) {
    const Ring outer = k == n_rings ? rim : add(k);
    stitch(mesh, inner, outer, p, q);
    inner = outer;
  }
}

Vec3 four_bubble_centre(double radius, Phase bubble) {
  const double s = radius / (2 * std::sqrt(2.0));
  constexpr std::array<std::array<int, 3>, 4> corner{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
  const auto& c = corner[bubble - 1];
  return {s * c[0], s * c[1], s * c[2]};
}

/// Outer junction opposite to a bubble.
Vec3 four_bubble_corner(double radius, Phase opposite) {
  return -four_bubble_border * radius * normalized(four_bubble_centre(radius, opposite));
}

/// The point a fraction of the way from a to b on the arc around a centre.
Vec3 on_arc(const Vec3& centre, const Vec3& a, const Vec3& b, double fraction) {
  const Vec3 u = a - centre, v = b - centre;
  const double angle = std::atan2(norm(cross(u, v)), dot(u, v));
  return centre + (std::sin((1 - fraction) * angle) / std::sin(angle)) * u +
         (std::sin(fraction * angle) / std::sin(angle)) * v;
}

/// A triangular patch of n rows: the apex at t = 0, the base at t = 1, u from one side to the other.
/// Its normal by the right-hand rule over (apex, base at u = 0, base at u = 1) points from p into q.
void add_patch(FilmMesh& mesh, int n, const std::function<Vec3(double t, double u)>& point, Phase p,
               Phase q) {
  const int first = mesh.n_vertices();
  const auto vertex = [&](int row, int k) { return first + row * (row + 1) / 2 + k; };
  for (int row = 0; row <= n; ++row)
    for (int k = 0; k <= row; ++k)
      mesh.position.push_back(
          point(static_cast<double>(row) / n, row == 0 ? 0.0 : static_cast<double>(k) / row));
  for (int row = 0; row < n; ++row)
    for (int k = 0; k <= row; ++k) {
      mesh.triangle.push_back(
          make_triangle(vertex(row, k), vertex(row + 1, k), vertex(row + 1, k + 1), p, q));
      if (k < row)
        mesh.triangle.push_back(
            make_triangle(vertex(row, k), vertex(row + 1, k + 1), vertex(row, k + 1), p, q));
    }
}

/// Unites vertices at the same place, up to round-off.
void unite_vertices(FilmMesh& mesh, double tolerance) {
  std::vector<int> same(mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    same[v] = v;
    for (int w = 0; w < v && same[v] == v; ++w)
      if (norm(mesh.position[v] - mesh.position[w]) < tolerance) same[v] = w;
  }
  for (auto& t : mesh.triangle)
    for (int& v : t.vertex) v = same[v];
  mesh::drop_unused_vertices(mesh);
}

/// The film between bubbles i and j: between two straight borders from the centre and an outer one.
void add_flat_film(FilmMesh& mesh, double radius, int n, Phase i, Phase j) {
  const Vec3 ci = four_bubble_centre(radius, i), cj = four_bubble_centre(radius, j);
  std::array<Vec3, 2> end;
  for (Phase k = 1, m = 0; k <= 4; ++k)
    if (k != i && k != j) end[m++] = four_bubble_corner(radius, k);
  const bool towards_j = dot(cross(end[0], end[1]), cj - ci) > 0;
  add_patch(
      mesh, n, [&](double t, double u) { return t * on_arc(0.5 * (ci + cj), end[0], end[1], u); },
      towards_j ? i : j, towards_j ? j : i);
}

/// A third of the outer film of bubble i: between its pole and its border with bubble j.
void add_outer_film(FilmMesh& mesh, double radius, int n, Phase i, Phase j) {
  const Vec3 ci = four_bubble_centre(radius, i), cj = four_bubble_centre(radius, j);
  const Vec3 pole = ci + radius * normalized(ci);
  std::array<Vec3, 2> end;
  for (Phase k = 1, m = 0; k <= 4; ++k)
    if (k != i && k != j) end[m++] = four_bubble_corner(radius, k);
  const bool outwards = dot(cross(end[0] - pole, end[1] - pole), pole) > 0;
  add_patch(
      mesh, n,
      [&](double t, double u) { return on_arc(ci, pole, on_arc(0.5 * (ci + cj), end[0], end[1], u), t); },
      outwards ? i : 0, outwards ? 0 : i);
}

/// The nearest point of the circle where two spheres of equal radius meet.
Vec3 on_circle_of_spheres(double radius, const Vec3& centre_a, const Vec3& centre_b, const Vec3& x) {
  const Vec3 axis = normalized(centre_b - centre_a), middle = 0.5 * (centre_a + centre_b);
  const double half = 0.5 * norm(centre_b - centre_a);
  const Vec3 r = x - middle;
  return middle + std::sqrt(radius * radius - half * half) * normalized(r - dot(r, axis) * axis);
}

}  // namespace

mesh::FilmMesh sphere(const Vec3& centre, double radius, int subdivisions, Phase inside) {
  const double g = std::numbers::phi;
  FilmMesh mesh;
  mesh.position = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  constexpr std::array<std::array<int, 3>, 20> face{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  std::vector<std::array<int, 3>> triangles(face.begin(), face.end());
  for (auto& x : mesh.position) x = normalized(x);
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto middle_of = [&](int a, int b) {
      const auto [entry, is_new] = middle.try_emplace(std::minmax(a, b), mesh.n_vertices());
      if (is_new) mesh.position.push_back(normalized(mesh.position[a] + mesh.position[b]));
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles.swap(finer);
  }
  for (auto& x : mesh.position) x = centre + radius * x;
  for (const auto& [a, b, c] : triangles) mesh.triangle.push_back(make_triangle(a, b, c, inside, 0));
  return mesh;
}

mesh::FilmMesh double_bubble(double radius, int n) {
  expects(n >= 2, "the ring of the double bubble needs twelve edges at least");
  FilmMesh mesh;
  const double ring_radius = 0.5 * std::sqrt(3.0) * radius;
  Ring inner = add_ring(mesh, 0, 0, 1);
  for (int k = 1; k <= n; ++k) {
    const Ring outer = add_ring(mesh, 0, ring_radius * k / n, 6 * k);
    stitch(mesh, inner, outer, 1, 2);
    inner = outer;
  }
  add_cap(mesh, radius, +1, inner, 2, 0);
  add_cap(mesh, radius, -1, inner, 0, 1);
  return mesh;
}

Vec3 on_double_bubble(double radius, const Vec3& x, const PhaseSet& phases) {
  const Vec3 centre_1{-0.5 * radius, 0, 0}, centre_2{0.5 * radius, 0, 0};
  if (phases.size() == 3) return on_circle_of_spheres(radius, centre_1, centre_2, x);
  if (phases == PhaseSet{1, 2}) return {0, x.y, x.z};
  const Vec3 centre = phases.contains(1) ? centre_1 : centre_2;
  return centre + radius * normalized(x - centre);
}

mesh::FilmMesh four_bubbles(double radius, int n) {
  FilmMesh mesh;
  for (Phase i = 1; i <= 4; ++i)
    for (Phase j = 1; j <= 4; ++j) {
      if (i < j) add_flat_film(mesh, radius, n, i, j);
      if (i != j) add_outer_film(mesh, radius, n, i, j);
    }
  unite_vertices(mesh, 1e-9 * radius);
  return mesh;
}

Vec3 on_four_bubbles(double radius, const Vec3& x, const PhaseSet& phases) {
  const auto centre = [&](Phase i) { return four_bubble_centre(radius, i); };
  const bool is_outer = phases.contains(0);
  if (phases.size() == 5) return {};
  if (phases.size() == 4 && !is_outer) return {};
  if (phases.size() == 4 || (phases.size() == 3 && !is_outer)) {
    Phase missing = 1;
    while (phases.contains(missing)) ++missing;
    const Vec3 corner = four_bubble_corner(radius, missing);
    return is_outer ? corner : (dot(x, corner) / norm_squared(corner)) * corner;
  }
  if (phases.size() == 3) return on_circle_of_spheres(radius, centre(phases[1]), centre(phases[2]), x);
  if (is_outer) return centre(phases[1]) + radius * normalized(x - centre(phases[1]));
  const Vec3 n = normalized(centre(phases[1]) - centre(phases[0]));
  return x - dot(x, n) * n;
}

FilmMesh sliced_ball(double radius, double width, double edge) {
  FilmMesh mesh;
  const double rim_angle = std::acos(0.5 * width / radius), rim = radius * std::sin(rim_angle);
  const auto count = [&](double circle) {
    return std::max(5, static_cast<int>(std::lround(2 * pi * circle / edge)));
  };
  const Ring left = add_ring(mesh, -0.5 * width, rim, count(rim)),
             right = add_ring(mesh, 0.5 * width, rim, count(rim));
  const auto number = [&](double length) {
    return std::max(1, static_cast<int>(std::lround(length / edge)));
  };
  // From an axis point outwards: `place` gives x and the distance from the axis at a fraction of the way.
  const auto fill = [&](const Ring& last, int n_rings, auto&& place, Phase p, Phase q) {
    Ring inner{};
    for (int k = 0; k <= n_rings; ++k) {
      const auto [x, circle] = place(static_cast<double>(k) / n_rings);
      const Ring outer = k == n_rings ? last : add_ring(mesh, x, circle, k == 0 ? 1 : count(circle));
      if (k > 0) stitch(mesh, inner, outer, p, q);
      inner = outer;
    }
  };
  for (const double sign : {-1.0, 1.0}) {
    const Ring& ring = sign < 0 ? left : right;
    const auto on_cap = [&](double t) {
      return std::pair(sign * radius * std::cos(t * rim_angle), radius * std::sin(t * rim_angle));
    };
    const auto on_disc = [&](double t) { return std::pair(sign * 0.5 * width, t * rim); };
    fill(ring, number(radius * rim_angle), on_cap, sign < 0 ? 0 : 3, sign < 0 ? 1 : 0);
    fill(ring, number(rim), on_disc, sign < 0 ? 1 : 2, sign < 0 ? 2 : 3);
  }
  Ring inner = right;
  const int n_rows = number(width);
  for (int k = 1; k <= n_rows; ++k) {
    const double x = width * (0.5 - static_cast<double>(k) / n_rows),
                 circle = std::sqrt(radius * radius - x * x);
    const Ring outer = k == n_rows ? left : add_ring(mesh, x, circle, count(circle));
    stitch(mesh, inner, outer, 2, 0);
    inner = outer;
  }
  return mesh;
}

Vec3 on_sliced_ball(double radius, double width, const Vec3& x, const PhaseSet& phases) {
  if (phases.size() == 2 && phases.contains(0)) return radius * normalized(x);
  const double plane = phases.contains(1) ? -0.5 * width : 0.5 * width;
  if (phases.size() == 2) return {plane, x.y, x.z};
  const double rim = std::sqrt(radius * radius - plane * plane);
  return Vec3{plane, 0, 0} + rim * normalized(Vec3{0, x.y, x.z});
}

int split_edge(mesh::FilmMesh& mesh, int a, int b, double fraction) {
  const int middle = mesh.n_vertices();
  mesh.position.push_back(mesh.position[a] + fraction * (mesh.position[b] - mesh.position[a]));
  for (int t = 0, n = mesh.n_triangles(); t < n; ++t) {
    mesh::FilmTriangle other = mesh.triangle[t];
    int n_ends = 0;
    for (int corner = 0; corner < 3; ++corner) {
      const int v = mesh.triangle[t].vertex[corner];
      n_ends += v == a || v == b;
    }
    if (n_ends < 2) continue;
    for (int& v : mesh.triangle[t].vertex)
      if (v == b) v = middle;
    for (int& v : other.vertex)
      if (v == a) v = middle;
    mesh.triangle.push_back(other);
  }
  return middle;
}

int euler_characteristic(const mesh::FilmMesh& mesh, Phase phase) {
  std::set<int> vertices;
  std::set<std::pair<int, int>> edges;
  int n_faces = 0;
  for (const auto& t : mesh.triangle) {
    if (t.phase_a != phase && t.phase_b != phase) continue;
    ++n_faces;
    for (int corner = 0; corner < 3; ++corner) {
      vertices.insert(t.vertex[corner]);
      edges.insert(std::minmax(t.vertex[corner], t.vertex[(corner + 1) % 3]));
    }
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + n_faces;
}

}  // namespace spume::shapes
