#include "networks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "spume/verification/film_networks.hpp"

namespace spume::drainage::testing {

state::FilmNetwork make_network(mesh::FilmMesh mesh, double eta, double lambda) {
  return verification::uniform_network(std::move(mesh), eta, lambda);
}

state::FilmNetwork square_film(double side, int n, double eta) {
  return make_network(verification::rectangle(side, side, n, n), eta, 0);
}

state::FilmNetwork single_bubble(double radius, int levels, double eta) {
  mesh::FilmMesh mesh;
  mesh.position = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<int, 3>> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                               {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto split = [&](int a, int b) {
      const auto [place, is_new] = middle.try_emplace(std::minmax(a, b), mesh.n_vertices());
      if (is_new) mesh.position.push_back(normalized(mesh.position[a] + mesh.position[b]));
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = split(a, b), bc = split(b, c), ca = split(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  for (Vec3& x : mesh.position) x *= radius;
  for (const auto& [a, b, c] : triangles) mesh.triangle.push_back(mesh::make_triangle(a, b, c, 1, 0));
  state::FilmNetwork network = make_network(std::move(mesh), eta, 0);
  std::fill(network.curvature_squared.begin(), network.curvature_squared.end(), 2 / (radius * radius));
  return network;
}

namespace {

/// A disc of triangles whose outermost ring of vertices is the first n_sectors vertices of the mesh.
void add_disc(mesh::FilmMesh& mesh, double radius, const std::vector<double>& rings, int n_sectors,
              double bulge, mesh::Phase below, mesh::Phase above) {
  const int first = mesh.n_vertices(), n_rings = static_cast<int>(rings.size());
  const auto point = [&](double r, int sector) {
    const double angle = 2 * std::numbers::pi * sector / n_sectors;
    return Vec3{bulge * (1 - r * r), radius * r * std::cos(angle), radius * r * std::sin(angle)};
  };
  mesh.position.push_back(point(0, 0));
  for (int ring = 0; ring + 1 < n_rings; ++ring)
    for (int s = 0; s < n_sectors; ++s) mesh.position.push_back(point(rings[ring], s));
  const auto at = [&](int ring, int s) {
    return ring + 1 == n_rings ? s % n_sectors : first + 1 + ring * n_sectors + s % n_sectors;
  };
  const auto add = [&](int a, int b, int c) {
    mesh.triangle.push_back(mesh::make_triangle(a, b, c, below, above));
  };
  for (int s = 0; s < n_sectors; ++s) {
    add(first, at(0, s), at(0, s + 1));
    for (int ring = 0; ring + 1 < n_rings; ++ring) {
      add(at(ring, s), at(ring + 1, s), at(ring + 1, s + 1));
      add(at(ring, s), at(ring + 1, s + 1), at(ring, s + 1));
    }
  }
}

}  // namespace

state::FilmNetwork double_bubble(double radius, const std::vector<double>& rings, int n_sectors, double eta,
                                 double lambda) {
  mesh::FilmMesh mesh;
  for (int s = 0; s < n_sectors; ++s) {
    const double angle = 2 * std::numbers::pi * s / n_sectors;
    mesh.position.push_back({0, radius * std::cos(angle), radius * std::sin(angle)});
  }
  add_disc(mesh, radius, rings, n_sectors, 0, 1, 2);
  add_disc(mesh, radius, rings, n_sectors, -radius, 0, 1);
  add_disc(mesh, radius, rings, n_sectors, radius, 2, 0);
  return make_network(std::move(mesh), eta, lambda);
}

state::FilmNetwork three_strips(const std::vector<double>& distances, double length, double eta,
                                double lambda) {
  return make_network(verification::three_strips(distances, std::array{0.0, length}), eta, lambda);
}

state::FilmNetwork tetrahedral_corner(const std::vector<double>& distances, double eta, double lambda) {
  const double c = 1 / std::numbers::sqrt3;
  const std::array<Vec3, 4> axis = {Vec3{c, c, c}, {c, -c, -c}, {-c, c, -c}, {-c, -c, c}};
  mesh::FilmMesh mesh;
  mesh.position.push_back({0, 0, 0});
  const int n = static_cast<int>(distances.size());
  for (int k = 0; k < 4; ++k)
    for (double r : distances) mesh.position.push_back(r * axis[k]);
  // The bubble of phase k + 1 lies opposite to axis k, so the film through the axes k, l parts the other two.
  for (int k = 0; k < 4; ++k)
    for (int l = k + 1; l < 4; ++l) {
      std::array<int, 2> other{};
      for (int m = 0, count = 0; m < 4; ++m)
        if (m != k && m != l) other[count++] = m;
      const bool towards_first = dot(cross(axis[k], axis[l]), axis[other[1]]) > 0;
      const mesh::Phase p = 1 + other[towards_first ? 1 : 0], q = 1 + other[towards_first ? 0 : 1];
      std::vector<int> near = {0};
      for (int row = 1; row <= n; ++row) {
        std::vector<int> far;
        for (int j = 0; j <= row; ++j) {
          const double s = static_cast<double>(j) / row;
          if (j == 0 || j == row) {
            far.push_back(1 + (j == 0 ? k : l) * n + row - 1);
            continue;
          }
          far.push_back(mesh.n_vertices());
          mesh.position.push_back(distances[row - 1] * ((1 - s) * axis[k] + s * axis[l]));
        }
        for (int j = 0; j < row; ++j) {
          mesh.triangle.push_back(mesh::make_triangle(near[j], far[j], far[j + 1], p, q));
          if (j + 1 < row)
            mesh.triangle.push_back(mesh::make_triangle(near[j], far[j + 1], near[j + 1], p, q));
        }
        near = std::move(far);
      }
    }
  return make_network(std::move(mesh), eta, lambda);
}

std::vector<double> geometric(double first, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(std::pow(first, 1 - static_cast<double>(i) / (n - 1)));
  return values;
}

state::ThinPoint thinnest_node(const state::FilmNetwork& network) {
  const auto least = std::min_element(network.half_thickness.begin(), network.half_thickness.end());
  const int dof = static_cast<int>(least - network.half_thickness.begin());
  const auto [vertex, lamella] = network.topology.film_dof[dof];
  return {dof, lamella, *least, network.topology.vertex_kind[vertex]};
}

}  // namespace spume::drainage::testing
