#include "spume/verification/film_networks.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "spume/base/contract.hpp"

namespace spume::verification {

state::FilmNetwork uniform_network(mesh::FilmMesh mesh, double half_thickness, double border_area) {
  state::FilmNetwork network;
  network.topology = mesh::build_topology(mesh);
  network.mesh = std::move(mesh);
  network.half_thickness.assign(network.topology.film_dof.size(), half_thickness);
  network.curvature_squared.assign(network.topology.film_dof.size(), 0.0);
  network.border_area.assign(network.mesh.n_vertices(), 0.0);
  for (const auto& dof : network.topology.border_dof) network.border_area[dof.vertex] = border_area;
  return network;
}

void add_band(mesh::FilmMesh& mesh, std::span<const int> near, std::span<const int> far, mesh::Phase p,
              mesh::Phase q) {
  std::size_t i = 0, j = 0;
  while (i + 1 < near.size() || j + 1 < far.size()) {
    const bool near_is_done = i + 1 == near.size(), far_is_done = j + 1 == far.size();
    const bool first = i == 0 && j == 0, last_of_far = j + 2 == far.size();
    const bool along_far =
        near_is_done ||
        (!far_is_done && (first || (!last_of_far && norm(mesh.edge(near[i], far[j + 1])) <=
                                                        norm(mesh.edge(near[i + 1], far[j])))));
    if (along_far) {
      mesh.triangle.push_back(mesh::make_triangle(near[i], far[j], far[j + 1], p, q));
      ++j;
    } else {
      mesh.triangle.push_back(mesh::make_triangle(near[i], far[j], near[i + 1], p, q));
      ++i;
    }
  }
}

mesh::FilmMesh rectangle(double width, double length, int n, int m) {
  mesh::FilmMesh mesh;
  const auto at = [n](int i, int j) { return i + (n + 1) * j; };
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) mesh.position.push_back({width * i / n, length * j / m, 0});
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangle.push_back(mesh::make_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), 0, 1));
      mesh.triangle.push_back(mesh::make_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1), 0, 1));
    }
  return mesh;
}

namespace {

using Face = std::array<Vec3, 3>;

/// The faces of an icosahedron on the unit sphere, seen from outside against the clock, with the axis z
/// through the middles of two of them.
std::vector<Face> icosahedron() {
  const double phi = std::numbers::phi, scale = 1 / std::sqrt(1 + phi * phi), edge = 2 * scale;
  std::vector<Vec3> corner;
  for (const double s : {-scale, scale})
    for (const double t : {-scale * phi, scale * phi})
      corner.insert(corner.end(), {{0, s, t}, {s, t, 0}, {t, 0, s}});
  const Vec3 w = normalized(Vec3{1, 1, 1}), u = normalized(Vec3{1, -1, 0}), v = cross(w, u);
  for (Vec3& x : corner) x = {dot(x, u), dot(x, v), dot(x, w)};
  const auto adjacent = [&](int a, int b) { return std::abs(norm(corner[a] - corner[b]) - edge) < 0.1; };
  std::vector<Face> faces;
  for (int a = 0; a < 12; ++a)
    for (int b = a + 1; b < 12; ++b)
      for (int c = b + 1; c < 12; ++c) {
        if (!adjacent(a, b) || !adjacent(b, c) || !adjacent(c, a)) continue;
        const bool outward = dot(corner[a], cross(corner[b], corner[c])) > 0;
        faces.push_back({corner[a], corner[outward ? b : c], corner[outward ? c : b]});
      }
  return faces;
}

/// Vertices by place, so that those that faces share are one.
class VerticesByPlace {
 public:
  explicit VerticesByPlace(mesh::FilmMesh& mesh) : mesh_(mesh) {}

  /// The vertex at x, where |x| is of order one.
  int at(const Vec3& x) {
    constexpr double grain = 1e-6;
    const std::array<long, 3> key{std::lround(x.x / grain), std::lround(x.y / grain),
                                  std::lround(x.z / grain)};
    const auto [known, is_new] = vertex_.try_emplace(key, mesh_.n_vertices());
    if (is_new) mesh_.position.push_back(x);
    return known->second;
  }

 private:
  mesh::FilmMesh& mesh_;
  std::map<std::array<long, 3>, int> vertex_;
};

}  // namespace

mesh::FilmMesh geodesic_sphere(double radius, int frequency) {
  expects(frequency > 0 && frequency % 3 == 0, "a frequency that is a multiple of three");
  mesh::FilmMesh mesh;
  VerticesByPlace vertices(mesh);
  for (const Face& face : icosahedron())
    for (int i = 0; i < frequency; ++i)
      for (int j = 0; i + j < frequency; ++j) {
        const auto at = [&](int m, int n) {
          const Vec3 flat = static_cast<double>(frequency - m - n) * face[0] +
                            static_cast<double>(m) * face[1] + static_cast<double>(n) * face[2];
          return vertices.at(normalized(flat));
        };
        mesh.triangle.push_back(mesh::make_triangle(at(i, j), at(i + 1, j), at(i, j + 1), 1, 0));
        if (i + j + 1 < frequency)
          mesh.triangle.push_back(mesh::make_triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), 1, 0));
      }
  for (Vec3& x : mesh.position) x *= radius;
  return mesh;
}

mesh::FilmMesh tube(double radius, double length, int n, int m) {
  mesh::FilmMesh mesh;
  const auto at = [n](int i, int j) { return i % n + n * j; };
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      mesh.position.push_back({radius * std::cos(angle), radius * std::sin(angle), length * j / m});
    }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangle.push_back(mesh::make_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), 1, 0));
      mesh.triangle.push_back(mesh::make_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1), 1, 0));
    }
  return mesh;
}

mesh::FilmMesh three_strips(std::span<const double> distances, std::span<const double> heights) {
  mesh::FilmMesh mesh;
  std::vector<int> border;
  for (const double z : heights) {
    border.push_back(mesh.n_vertices());
    mesh.position.push_back({0, 0, z});
  }
  for (int film = 0; film < 3; ++film) {
    const double angle = 2 * std::numbers::pi * film / 3;
    const Vec3 outward{std::cos(angle), std::sin(angle), 0};
    const mesh::Phase clockwise = 1 + (film + 2) % 3, counter_clockwise = 1 + film;
    std::vector<int> near = border;
    for (std::size_t n = 1; n < distances.size(); ++n) {
      std::vector<int> far;
      for (const double z : heights) {
        far.push_back(mesh.n_vertices());
        mesh.position.push_back(distances[n] * outward + Vec3{0, 0, z});
      }
      // The normal of (near, far, next far) points clockwise.
      for (std::size_t j = 0; j + 1 < heights.size(); ++j) {
        mesh.triangle.push_back(
            mesh::make_triangle(near[j], far[j], far[j + 1], counter_clockwise, clockwise));
        mesh.triangle.push_back(
            mesh::make_triangle(near[j], far[j + 1], near[j + 1], counter_clockwise, clockwise));
      }
      near = std::move(far);
    }
  }
  return mesh;
}

mesh::FilmMesh tetrahedral_corner(double spacing, int rows) {
  const double c = 1 / std::numbers::sqrt3;
  const std::array<Vec3, 4> axis = {Vec3{c, c, c}, {c, -c, -c}, {-c, c, -c}, {-c, -c, c}};
  const double opening = norm(axis[0] - axis[1]);
  mesh::FilmMesh mesh;
  mesh.position.push_back({0, 0, 0});
  for (const Vec3& along : axis)
    for (int row = 1; row <= rows; ++row) mesh.position.push_back(spacing * row * along);
  const auto on_axis = [rows](int k, int row) { return 1 + k * rows + row - 1; };
  // The bubble of phase k + 1 lies opposite to axis k, so the film through the axes k, l parts the other two.
  for (int k = 0; k < 4; ++k)
    for (int l = k + 1; l < 4; ++l) {
      std::array<int, 2> other{};
      for (int m = 0, count = 0; m < 4; ++m)
        if (m != k && m != l) other[count++] = m;
      const bool towards_first = dot(cross(axis[k], axis[l]), axis[other[1]]) > 0;
      const mesh::Phase p = 1 + other[towards_first ? 1 : 0], q = 1 + other[towards_first ? 0 : 1];
      std::vector<int> near = {0};
      for (int row = 1; row <= rows; ++row) {
        const int pieces = row == 1 ? 1 : static_cast<int>(std::lround(opening * row));
        std::vector<int> far{on_axis(k, row)};
        for (int j = 1; j < pieces; ++j) {
          const double s = static_cast<double>(j) / pieces;
          far.push_back(mesh.n_vertices());
          mesh.position.push_back(spacing * row * ((1 - s) * axis[k] + s * axis[l]));
        }
        far.push_back(on_axis(l, row));
        add_band(mesh, near, far, p, q);
        near = std::move(far);
      }
    }
  return mesh;
}

}  // namespace spume::verification
