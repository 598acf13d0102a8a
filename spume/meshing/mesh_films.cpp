#include "spume/meshing/mesh_films.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "spume/base/flat_map.hpp"
#include "spume/mesh/collapse.hpp"
#include "spume/mesh/flip.hpp"
#include "spume/mesh/split.hpp"
#include "spume/meshing/moves.hpp"
#include "spume/meshing/repair.hpp"
#include "spume/meshing/size_field.hpp"

namespace spume::meshing {

namespace {

// To be on the film is worth more than a good angle, up to these [degrees]. What is poor at first improves.
constexpr double least_angle_at_first = 5, least_angle = 22;
constexpr int sweeps_after_corners = 5;

/// Sizes of places that are asked for again and again: splits and collapses leave the other vertices where
/// they are.
class RememberedSizes {
 public:
  explicit RememberedSizes(const SizeField& size) : size_(size) {}
  double operator()(const Vec3& x) {
    const auto next = static_cast<int>(value_.size());
    const int n = number_.find_or_insert(x, next);
    if (n == next) value_.push_back(size_(x));
    return value_[n];
  }

 private:
  struct Hash {
    std::size_t operator()(const Vec3& x) const {
      std::uint64_t hash = 0;
      for (int d = 0; d < 3; ++d) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(x[d])) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
      }
      return hash;
    }
  };

  const SizeField& size_;
  FlatMap<Vec3, Hash> number_;
  std::vector<double> value_;
};

/// Splits and collapses until edges fit their targets, or nearly.
void fit_edges(mesh::WorkingMesh& work, const mesh::TargetLength& target, const mesh::Projection& project,
               mesh::RemeshReport& report) {
  constexpr int most_rounds = 4, most_split_passes = 24;
  mesh::RemeshParameters parameters;
  parameters.split_above = 1.4;
  for (int round = 0; round < most_rounds; ++round) {
    const int n_before = report.n_split + report.n_collapsed;
    for (int pass = 0; pass < most_split_passes; ++pass) {
      const int n_split = mesh::split_long_edges(work, target, project, parameters.split_above);
      if (n_split == 0) break;
      report.n_split += n_split;
      report.n_flipped += mesh::flip_edges(work);
    }
    report.n_collapsed += mesh::collapse_short_edges(work, target, parameters);
    report.n_flipped += mesh::flip_edges(work);
    if (report.n_split + report.n_collapsed == n_before) break;
  }
}

/// Sweeps of moves and flips, until hardly a vertex moves.
void move_and_flip(mesh::WorkingMesh& work, const mesh::Projection& project,
                   std::span<const double> target_length, int n_sweeps, mesh::RemeshReport& report) {
  for (int sweep = 0; sweep < n_sweeps; ++sweep) {
    StarMesh star_mesh(work);
    const int n_moved = move_vertices(star_mesh, project, target_length);
    report.n_flipped += mesh::flip_edges(work);
    if (100 * n_moved < work.mesh.n_vertices()) break;
  }
}

Sizes sizes_of(double h, const MeshingParameters& p) {
  const double in_films = p.edge * h;
  const double coarsest = p.coarsest_at_borders * h, finest = std::min(p.finest_at_borders * h, coarsest);
  double at_borders = p.edge_at_borders;
  if (!(at_borders > 0))
    at_borders = p.layer_width > 0 ? std::clamp(0.5 * p.layer_width, finest, coarsest) : coarsest;
  at_borders = std::min(at_borders, in_films);
  const double at_junctions =
      p.edge_at_junctions > 0 ? std::min(p.edge_at_junctions, at_borders) : at_borders;
  return {in_films, at_borders, at_junctions, p.smallest_edge * h, p.grading};
}

}  // namespace

double drainage_layer_width(double half_thickness, double border_area) {
  return std::sqrt(half_thickness * std::sqrt(border_area / (std::numbers::sqrt3 - std::numbers::pi / 2)));
}

MeshingReport improve(mesh::FilmMesh& films, const mesh::Projection& project, double h,
                      const MeshingParameters& parameters) {
  MeshingReport report;
  const SizeField size(films, mesh::build_topology(films), sizes_of(h, parameters));
  const mesh::TargetLength target = [&](const Vec3& x) { return size(x); };
  mesh::WorkingMesh work(films);
  {
    RememberedSizes remembered(size);
    fit_edges(work, std::ref(remembered), project, report.remesh);
  }
  {
    StarMesh star_mesh(work);
    project_vertices(star_mesh, project, least_angle_at_first);
  }
  move_and_flip(work, project, mesh::targets_at_vertices(films, target), parameters.sweeps, report.remesh);

  const std::vector<double> target_length = mesh::targets_at_vertices(films, target);
  StarMesh star_mesh(work);
  if (parameters.one_triangle_a_corner) {
    report.remesh.n_flipped += fill_corners(star_mesh, project);
    for (int sweep = 0; sweep < sweeps_after_corners; ++sweep)
      move_vertices(star_mesh, project, target_length);
  }
  project_vertices(star_mesh, project, least_angle);
  report.repair = repair(star_mesh, project, target_length, parameters.wanted_angle_degrees);
  report.n_off = project_vertices(star_mesh, project, least_angle);
  work.remove(star_mesh.dead);
  report.after = mesh::measure_quality(films, mesh::build_topology(films));
  return report;
}

int follow_films(mesh::FilmMesh& films, const mesh::Projection& project) {
  mesh::WorkingMesh work(films);
  StarMesh star_mesh(work);
  return project_vertices(star_mesh, project, least_angle);
}

}  // namespace spume::meshing
