
#include <algorithm>
#include <limits>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/base/random.hpp"
#include "spume/grid/loops.hpp"
#include "spume/interface/clearance.hpp"
#include "spume/interface/find_films.hpp"
#include "spume/interface/potentials.hpp"
#include "spume/interface/reconstruct.hpp"
#include "spume/interface/smooth_area.hpp"
#include "spume/mesh/volume_constraint.hpp"

namespace spume::interface {

namespace {

using Potential = std::function<double(mesh::Phase, const Vec3&)>;

/// The phase with the largest potential at every cell. Collective.
std::vector<mesh::Phase> winners_of(const grid::Grid& grid, const Potential& potential, int n_phases) {
  grid::Field winner(grid);
  auto value = grid::owned(winner);
  grid::for_each_cell(grid, [&](int i, int j, int k) {
    const Vec3 x = grid.centre(i, j, k);
    mesh::Phase best = 0;
    double largest = potential(0, x);
    for (mesh::Phase p = 1; p < n_phases; ++p) {
      const double v = potential(p, x);
      if (v <= largest) continue;
      largest = v;
      best = p;
    }
    value(i, j, k) = best;
  });
  const std::vector<double> whole = grid::gather(winner);
  return {whole.begin(), whole.end()};
}

/// The block of cells that each phase wins: along a periodic direction all but the longest free stretch.
std::vector<CellBox> blocks_of_phases(const Lattice& lattice, const std::vector<mesh::Phase>& winner,
                                      int n_phases) {
  std::vector<CellBox> blocks(n_phases, no_cells());
  for (int d = 0; d < 3; ++d) {
    const int n_cells = lattice.cells[d];
    std::vector<char> taken(static_cast<std::size_t>(n_phases) * n_cells, 0);
    std::size_t n = 0;
    for_each_cell(all_cells(lattice.cells), [&](int i, int j, int k) {
      taken[static_cast<std::size_t>(winner[n++]) * n_cells + Index3{i, j, k}[d]] = 1;
    });
    for (mesh::Phase p = 0; p < n_phases; ++p) {
      const char* of_phase = &taken[static_cast<std::size_t>(p) * n_cells];
      int free = 0, longest = 0, begin = 0;
      for (int m = 0; m < 2 * n_cells; ++m) {
        free = of_phase[m % n_cells] ? 0 : free + 1;
        if (free > longest && free <= n_cells) {
          longest = free;
          begin = (m + 1) % n_cells;
        }
      }
      if (longest == n_cells) continue;  // nowhere
      if (!lattice.periodic[d]) {
        begin = static_cast<int>(std::find(of_phase, of_phase + n_cells, 1) - of_phase);
        longest = n_cells - 1;
        while (!of_phase[longest]) --longest;
        blocks[p].begin[d] = begin;
        blocks[p].end[d] = longest + 1;
      } else {
        blocks[p].begin[d] = begin;
        blocks[p].end[d] = begin + n_cells - longest;
      }
    }
  }
  return blocks;
}

/// Samples of the functions around the cells that each phase wins, with noise of 1e-7 h, which breaks the
/// exact ties of symmetric starts.
PhasePotentials sample(const grid::Grid& grid, const Potential& potential, int n_phases) {
  constexpr int reach = 6;
  const double noise = 1e-7 * grid.h();
  const std::vector<mesh::Phase> winner = winners_of(grid, potential, n_phases);
  PhasePotentials potentials(grid.box());
  const Lattice& lattice = potentials.lattice();
  const std::vector<CellBox> cells = blocks_of_phases(lattice, winner, n_phases);
  for (mesh::Phase p = 0; p < n_phases; ++p) {
    if (p > 0 && cells[p].empty()) continue;
    Random random(static_cast<std::uint64_t>(p));
    PhaseField field{p,
                     p == 0 ? all_cells(grid.cells()) : lattice.grown(cells[p], reach),
                     -std::numeric_limits<double>::max(),
                     {}};
    field.value.reserve(field.cells.size());
    for_each_cell(field.cells, [&](int i, int j, int k) {
      const int x = lattice.image(i, 0, 0), y = lattice.image(j, 0, 1), z = lattice.image(k, 0, 2);
      field.value.push_back(potential(p, grid.centre(x, y, z)) + noise * random.uniform(-0.5, 0.5));
    });
    potentials.set(std::move(field));
  }
  return potentials;
}

/// The phase whose function holds for each phase: itself, or for one born by separate_pieces() the one it
/// came from.
std::vector<mesh::Phase> functions_of_phases(int n_phases, const std::vector<PhaseChange>& changes) {
  std::vector<mesh::Phase> function(n_phases);
  for (mesh::Phase p = 0; p < n_phases; ++p) function[p] = p;
  for (const PhaseChange& c : changes) function[c.other] = function[c.phase];
  return function;
}

/// Moves film vertices onto the tie of the functions themselves by Newton's method: linear interpolation
/// between cells leaves curved films inside. Vertices of borders stay, and those that would move far.
void project_on_functions(const Potential& potential, const std::vector<mesh::Phase>& function,
                          const mesh::Topology& topology, double h, mesh::FilmMesh& films) {
  constexpr int n_iterations = 4;
  const double step = 1e-3 * h;
  for (int v = 0; v < films.n_vertices(); ++v) {
    const mesh::PhaseSet& phases = topology.vertex_phases[v];
    if (phases.size() != 2) continue;
    const auto difference = [&](const Vec3& x) {
      return potential(function[phases[0]], x) - potential(function[phases[1]], x);
    };
    Vec3 x = films.position[v];
    for (int n = 0; n < n_iterations; ++n) {
      Vec3 gradient;
      for (int d = 0; d < 3; ++d) {
        Vec3 up = x, down = x;
        up[d] += step;
        down[d] -= step;
        gradient[d] = (difference(up) - difference(down)) / (2 * step);
      }
      const double g2 = norm_squared(gradient);
      if (g2 > 0) x -= difference(x) / g2 * gradient;
    }
    if (norm(x - films.position[v]) < 0.5 * h) films.position[v] = x;
  }
}

/// Reports of two passes as one: what was done adds up, what is left is that of the last.
void append(ReconstructReport& report, ReconstructReport&& next) {
  next.changes.insert(next.changes.begin(), report.changes.begin(), report.changes.end());
  report = std::move(next);
}

}  // namespace

Reconstruction construct(const grid::Grid& grid, const Potential& potential, state::Phases& phases,
                         const ReconstructParameters& parameters) {
  const double h = grid.h(), edge = parameters.smallest_bubble_cells * h,
               smallest_volume = edge * edge * edge;
  const int n_functions = phases.count();
  const std::vector<double> wanted = phases.target_volume;

  PhasePotentials start = sample(grid, potential, n_functions);
  ReconstructReport report;
  // All phases count as alive here; their targets are the volumes found.
  FoundFilms found = find_films(grid.communicator(), start, find_winners(start, grid.communicator()), phases,
                                smallest_volume, report.changes);
  project_on_functions(potential, functions_of_phases(phases.count(), report.changes), found.topology, h,
                       found.films);
  if (const auto problem = clearance_problem(grid, found.films); !problem.empty()) throw InputError(problem);
  const std::vector<double> volume = smooth_phase_volumes(found.films, found.topology, phases.count());
  std::copy(volume.begin() + 1, volume.end(), phases.target_volume.begin() + 1);
  for (auto& change : report.changes)
    if (change.other != change.phase) change.volume = volume[change.other];

  for (mesh::Phase p = 1; p < n_functions; ++p)
    if (!start.find(p)) report.changes.push_back({ReconstructReport::PhaseChange::Kind::Lost, p, 0, 0.0});

  Reconstruction result{std::move(found.films), std::move(found.topology), std::move(report), nullptr};
  for (int pass = 0; pass < 2; ++pass) {
    Reconstruction next = reconstruct(grid, result.films, result.topology, phases, parameters);
    append(result.report, std::move(next.report));
    next.report = std::move(result.report);
    result = std::move(next);
  }
  bool any_wanted = false;
  for (mesh::Phase p = 1; p < n_functions; ++p) {
    const bool split = std::any_of(
        result.report.changes.begin(), result.report.changes.end(),
        [&](const auto& c) { return c.phase == p && c.kind == ReconstructReport::PhaseChange::Kind::Split; });
    if (!(wanted[p] > 0) || !phases.alive(p) || split) continue;
    phases.target_volume[p] = wanted[p];
    any_wanted = true;
  }
  if (any_wanted && parameters.conserve_volumes)
    result.report.largest_volume_displacement =
        mesh::restore_volumes(result.films, phases.target_volume, 3, 0.2 * h);
  return result;
}

}  // namespace spume::interface
