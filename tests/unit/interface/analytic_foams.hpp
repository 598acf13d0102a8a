#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "spume/base/random.hpp"
#include "spume/grid/box.hpp"
#include "spume/interface/potentials.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/state/phases.hpp"

namespace spume::interface::testing {

inline constexpr double h = 1e-4;  ///< cell of all tests [m]

inline grid::Box cube_box(int cells) {
  return {{-0.5 * cells * h, -0.5 * cells * h, -0.5 * cells * h},
          {0.5 * cells * h, 0.5 * cells * h, 0.5 * cells * h},
          {cells, cells, cells}};
}

inline grid::Box walled(grid::Box box) {
  box.boundary.fill(grid::Boundary::Slip);
  return box;
}

using Potential = std::function<double(mesh::Phase, const Vec3&)>;

struct Ball {
  Vec3 centre;
  double radius;
};

/// Phase p ≥ 1 is ball p − 1; two balls meet in their power plane, the outside is what no ball covers.
inline Potential power_diagram(std::vector<Ball> balls) {
  return [balls = std::move(balls)](mesh::Phase p, const Vec3& x) {
    const auto of = [&](const Ball& b) {
      return (b.radius * b.radius - norm_squared(x - b.centre)) / (2 * b.radius);
    };
    if (p > 0) return of(balls[p - 1]);
    double largest = of(balls[0]);
    for (const Ball& b : balls) largest = std::max(largest, of(b));
    return -largest;
  };
}

inline Vec3 turned(const Vec3& p) {  // by angles without meaning, so that nothing is aligned with the grid
  const Vec3 q{std::cos(0.37) * p.x - std::sin(0.37) * p.y, std::sin(0.37) * p.x + std::cos(0.37) * p.y, p.z};
  const Vec3 r{q.x, std::cos(0.61) * q.y - std::sin(0.61) * q.z, std::sin(0.61) * q.y + std::cos(0.61) * q.z};
  return {std::cos(0.23) * r.x + std::sin(0.23) * r.z, r.y, -std::sin(0.23) * r.x + std::cos(0.23) * r.z};
}

/// Four equal balls of radius R with centres on a regular tetrahedron of edge R, off the lattice.
inline std::vector<Ball> tetrahedral_cluster(double radius) {
  const double s = 0.5 / std::sqrt(2.0);
  std::vector<Ball> balls;
  for (const Vec3& c : {Vec3{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}})
    balls.push_back({radius * turned(c) + h * Vec3{0.137, 0.371, 0.219}, radius});
  return balls;
}

/// Balls that overlap their neighbours, at random places around the centre.
inline std::vector<Ball> random_balls(int n, double radius, std::uint64_t seed) {
  Random random(seed);
  std::vector<Ball> balls;
  while (static_cast<int>(balls.size()) < n) {
    const double reach = radius * std::cbrt(static_cast<double>(n));
    const Vec3 c{random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
    const double r = radius * random.uniform(0.8, 1.2);
    const bool is_free = std::all_of(balls.begin(), balls.end(), [&](const Ball& b) {
      return norm(c - b.centre) > 0.9 * (r + b.radius) * 0.8;
    });
    if (norm(c) < reach && is_free) balls.push_back({c, r});
  }
  return balls;
}

/// Samples of functions on the whole grid as potentials.
inline PhasePotentials sampled(const grid::Box& box, const Potential& potential, int n_phases) {
  PhasePotentials potentials(box);
  for (mesh::Phase p = 0; p < n_phases; ++p) {
    PhaseField field{p, all_cells(box.cells), 0, {}};
    for_each_cell(field.cells, [&](int i, int j, int k) {
      field.value.push_back(potential(p, box.lower + box.spacing() * Vec3{i + 0.5, j + 0.5, k + 0.5}));
    });
    potentials.set(std::move(field));
  }
  return potentials;
}

inline state::Phases unset_phases(int n_bubbles) {
  state::Phases phases;
  phases.target_volume.assign(n_bubbles + 1, 0.0);
  return phases;
}

/// A closed sphere of phase 1 from an icosahedron divided `levels` times.
inline mesh::FilmMesh icosphere(const Vec3& centre, double radius, int levels) {
  mesh::FilmMesh mesh;
  const double g = (1 + std::sqrt(5.0)) / 2;
  for (const Vec3& v : {Vec3{-1, g, 0},
                        {1, g, 0},
                        {-1, -g, 0},
                        {1, -g, 0},
                        {0, -1, g},
                        {0, 1, g},
                        {0, -1, -g},
                        {0, 1, -g},
                        {g, 0, -1},
                        {g, 0, 1},
                        {-g, 0, -1},
                        {-g, 0, 1}})
    mesh.position.push_back(normalized(v));
  std::vector<std::array<int, 3>> triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                            {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                            {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                            {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::vector<std::array<int, 3>> finer;
    std::vector<std::array<int, 3>> known;  // low, high, midpoint
    const auto middle = [&](int a, int b) {
      if (a > b) std::swap(a, b);
      for (const auto& k : known)
        if (k[0] == a && k[1] == b) return k[2];
      mesh.position.push_back(normalized(mesh.position[a] + mesh.position[b]));
      known.push_back({a, b, mesh.n_vertices() - 1});
      return mesh.n_vertices() - 1;
    };
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  for (auto& x : mesh.position) x = centre + radius * x;
  for (const auto& [a, b, c] : triangles) mesh.triangle.push_back(mesh::make_triangle(a, b, c, 1, 0));
  return mesh;
}

}  // namespace spume::interface::testing
