#include "spume/viim/voronoi.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "spume/interface/contour.hpp"
#include "spume/viim/closest_points.hpp"
#include "spume/viim/local_cubic.hpp"

namespace spume::viim {

namespace {

using interface::CellBox;
using interface::PhaseField;

constexpr double beyond_films = 3.5;  // cells: as far as tricubics around a film reach

grid::Box box_of(const grid::Box& whole, const CellBox& cells) {
  const double h = whole.spacing();
  const auto corner = [&](const Index3& c) {
    return whole.lower +
           h * Vec3{static_cast<double>(c.i), static_cast<double>(c.j), static_cast<double>(c.k)};
  };
  return {corner(cells.begin),
          corner(cells.end),
          {cells.end.i - cells.begin.i, cells.end.j - cells.begin.j, cells.end.k - cells.begin.k},
          whole.boundary};
}

/// {excess = 0}, with vertices on the tricubic interpolation where Newton's method puts them there.
mesh::FilmMesh level_surface(const grid::Box& box, const std::vector<double>& excess) {
  interface::PhasePotentials sides(box);
  PhaseField inside{1, interface::all_cells(box.cells), excess.front(), excess}, outside = inside;
  outside.phase = 0;
  for (double& value : outside.value) value = -value;
  outside.beyond = -outside.beyond;
  sides.set(std::move(outside));
  sides.set(std::move(inside));
  mesh::FilmMesh surface = interface::contour(
      parallel::Communicator::self(), sides, interface::find_winners(sides), interface::Pieces::OfTetrahedra);
  for (Vec3& x : surface.position)
    if (const auto projected = sides.project(x, {0, 1})) x = *projected;
  return surface;
}

/// ψ of one phase on a block of cells.
PhaseField potential_of(const DistanceField& field, mesh::Phase phase, const CellBox& cells, double epsilon) {
  const double h = field.box.spacing(), reach = epsilon + beyond_films * h;
  const grid::Box box = box_of(field.box, cells);
  std::vector<double> excess = signed_distance(field, phase, cells);
  for (double& value : excess) value -= epsilon;
  const CellBox local = interface::all_cells(box.cells);
  const auto excess_at = [&](int i, int j, int k) {
    const auto inside = [](int c, int n) { return std::clamp(c, 0, n - 1); };
    return excess[local.offset(inside(i, box.cells.i), inside(j, box.cells.j), inside(k, box.cells.k))];
  };

  // Deep in the core, where no tricubic around a film reaches, φ itself will do.
  const double deep = std::max(beyond_films * h - epsilon, h);
  PhaseField potential{phase, cells, epsilon - reach, {}};
  potential.value.reserve(excess.size());
  std::vector<bool> wanted;
  wanted.reserve(excess.size());
  for (double value : excess) {
    potential.value.push_back(value > 0 ? epsilon + value : epsilon - reach);
    wanted.push_back(value < deep);
  }
  for (const ClosestPoint& p : closest_points(level_surface(box, excess), box, reach, wanted)) {
    const auto foot = LocalCubic(box, p.point, excess_at).closest_zero(p.centre, p.point);
    const double d = foot ? norm(p.centre - *foot) : p.distance;
    potential.value[p.cell] = epsilon + (excess[p.cell] > 0 ? d : -d);
  }
  return potential;
}

/// Bounding boxes of the cells of each phase where φ > ε; empty for the others.
std::vector<CellBox> core_cells(const DistanceField& field, int n_phases, double epsilon) {
  std::vector<CellBox> cores(n_phases, interface::no_cells());
  std::size_t n = 0;
  interface::for_each_cell(interface::all_cells(field.box.cells), [&](int i, int j, int k) {
    if (field.distance[n] > epsilon) cores[field.phase[n]].include(i, j, k);
    ++n;
  });
  return cores;
}

}  // namespace

interface::PhasePotentials voronoi_potentials(const DistanceField& field, double epsilon) {
  const int n_phases = 1 + *std::max_element(field.phase.begin(), field.phase.end());
  const int layers = static_cast<int>(std::ceil(epsilon / field.box.spacing() + beyond_films)) + 1;
  const std::vector<CellBox> cores = core_cells(field, n_phases, epsilon);
  interface::PhasePotentials potentials(field.box);
  for (mesh::Phase p = 0; p < n_phases; ++p) {
    if (cores[p].empty()) continue;
    const CellBox cells = p == 0 ? interface::all_cells(field.box.cells) : interface::Lattice {
      field.box.cells
    }.grown(cores[p], layers);
    potentials.set(potential_of(field, p, cells, epsilon));
  }
  return potentials;
}

std::vector<mesh::Phase> phases_without_core(const DistanceField& field, const state::Phases& phases,
                                             double epsilon) {
  const std::vector<CellBox> cores = core_cells(field, phases.count(), epsilon);
  std::vector<mesh::Phase> without;
  for (mesh::Phase p = 1; p < phases.count(); ++p)
    if (phases.alive(p) && cores[p].empty()) without.push_back(p);
  return without;
}

}  // namespace spume::viim
