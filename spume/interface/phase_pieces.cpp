#include "spume/interface/phase_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "spume/base/union_find.hpp"
#include "spume/interface/smooth_area.hpp"

namespace spume::interface {

namespace {

constexpr int reach = 6;  // of a piece, in cells

std::vector<CellRun> find_runs(const Index3& cells, const std::vector<mesh::Phase>& winner,
                               std::vector<int>& first_of_row) {
  std::vector<CellRun> runs;
  const mesh::Phase* row = winner.data();
  for (int k = 0; k < cells.k; ++k)
    for (int j = 0; j < cells.j; ++j, row += cells.i) {
      first_of_row.push_back(static_cast<int>(runs.size()));
      for (int i = 0; i < cells.i;) {
        const mesh::Phase phase = row[i];
        const int begin = i;
        while (i < cells.i && row[i] == phase) ++i;
        runs.push_back({begin, i, j, k, phase, -1});
      }
    }
  first_of_row.push_back(static_cast<int>(runs.size()));
  return runs;
}

/// Distances [cells] from the cells of a window to the nearest cell of some pieces of a phase, cut off at
/// `reach`.
class PieceDistance {
 public:
  PieceDistance(const Lattice& lattice, const std::vector<mesh::Phase>& winner)
      : lattice_(lattice), whole_(all_cells(lattice.cells)), winner_(winner) {
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i) {
          const double d = std::sqrt(static_cast<double>(i * i + j * j + k * k));
          if (d < reach) ball_.push_back({{i, j, k}, d});
        }
  }

  template <class Accept>
  std::vector<double> operator()(const PhasePieces& pieces, const CellBox& window, Accept&& accept) const {
    std::vector<double> distance(window.size(), reach);
    const CellBox sources = lattice_.grown(window, reach);
    for (const CellRun& run : pieces.run) {
      if (!accept(run.piece)) continue;
      for (int i = run.i_begin; i < run.i_end; ++i) {
        const Index3 source = lattice_.image_in(sources, i, run.j, run.k);
        if (!sources.contains(source.i, source.j, source.k)) continue;
        if (is_interior(i, run.j, run.k, run.phase))
          note(i, run.j, run.k, 0, window, distance);
        else
          for (const auto& [step, d] : ball_)
            note(i + step.i, run.j + step.j, run.k + step.k, d, window, distance);
      }
    }
    return distance;
  }

 private:
  struct Offset {
    Index3 step;
    double distance;
  };

  bool is_interior(int i, int j, int k, mesh::Phase phase) const {
    const auto same = [&](int a, int b, int c) {
      const Index3 cell = lattice_.image_in(whole_, a, b, c);
      return !whole_.contains(cell.i, cell.j, cell.k) ||
             winner_[whole_.offset(cell.i, cell.j, cell.k)] == phase;
    };
    return same(i - 1, j, k) && same(i + 1, j, k) && same(i, j - 1, k) && same(i, j + 1, k) &&
           same(i, j, k - 1) && same(i, j, k + 1);
  }
  void note(int i, int j, int k, double d, const CellBox& window, std::vector<double>& distance) const {
    const Index3 cell = lattice_.image_in(window, i, j, k);
    if (!window.contains(cell.i, cell.j, cell.k)) return;
    double& known = distance[window.offset(cell.i, cell.j, cell.k)];
    known = std::min(known, d);
  }

  Lattice lattice_;
  CellBox whole_;
  const std::vector<mesh::Phase>& winner_;
  std::vector<Offset> ball_;
};

/// The piece that keeps the phase.
int main_piece(const PhasePieces& pieces, const std::vector<int>& of_phase) {
  return *std::max_element(of_phase.begin(), of_phase.end(), [&](int a, int b) {
    return pieces.piece[a].n_cells < pieces.piece[b].n_cells;  // the first of equals
  });
}

/// ψ of a piece of its own, cut out of that of its phase; the phase is lowered there.
PhaseField cut_out(PhaseField& parent, const CellBox& window, const std::vector<double>& to_piece,
                   const std::vector<double>& to_others, double slope, mesh::Phase child) {
  PhaseField field{child, window, parent.beyond, {}};
  field.value.reserve(window.size());
  std::size_t n = 0;
  for_each_cell(window, [&](int i, int j, int k) {
    const double nearer = to_others[n] - to_piece[n];  // how much nearer to the piece than to the others
    ++n;
    const double value = parent.at(i, j, k);
    field.value.push_back(value + slope * std::min(0.0, nearer));
    if (const auto place = parent.place(i, j, k))
      parent.value[*place] = value - slope * std::max(0.0, nearer);
  });
  return field;
}

void mark_large(const Domain& domain, std::vector<ClosedSurface>& surfaces) {
  constexpr double large = 0.4;
  for (ClosedSurface& s : surfaces)
    for (int d = 0; d < 3; ++d)
      if (domain.periodic[d] && s.upper[d] - s.lower[d] > large * domain.size[d])
        s.volume = std::numeric_limits<double>::infinity();
}

/// The surface of each side of each lamella, [2 lamella] of its phase_a and [2 lamella + 1] of its phase_b;
/// gives their number.
int number_surfaces(const mesh::FilmMesh& films, const mesh::Topology& topology,
                    std::vector<int>& surface_of_side) {
  UnionFind classes(2 * topology.n_lamellae());
  std::map<mesh::Phase, int> met;  // a side of each phase at a vertex
  for (int v = 0; v < films.n_vertices(); ++v) {
    if (topology.vertex_phases[v].size() < 3) continue;
    met.clear();
    for (int n = topology.star_offset[v]; n < topology.star_offset[v + 1]; ++n) {
      const int t = topology.star_triangle[n], side = 2 * topology.triangle_lamella[t];
      classes.join(met.emplace(films.triangle[t].phase_a, side).first->second, side);
      classes.join(met.emplace(films.triangle[t].phase_b, side + 1).first->second, side + 1);
    }
  }
  return classes.number(surface_of_side);
}

/// Calls visit(n, m, is_sure) for runs n and m of one phase that are linked; not sure are links through
/// corners of cells alone, along the diagonals of cubes.
template <class Visit>
void for_each_link(const Lattice& lattice, const std::vector<CellRun>& runs,
                   const std::vector<int>& first_of_row, Visit&& visit) {
  const Index3& cells = lattice.cells;
  // Links of a row to the rows one step up in j, in k, or in both; along i they reach from 0 to 1.
  constexpr std::array<std::array<int, 2>, 3> steps{{{1, 0}, {0, 1}, {1, 1}}};
  for (int n = 0; n < static_cast<int>(runs.size()); ++n) {
    const CellRun& run = runs[n];
    const bool goes_over = lattice.periodic[0] && run.i_end == cells.i;
    const int first = first_of_row[run.k * cells.j + run.j];
    if (goes_over && runs[first].phase == run.phase) visit(n, first, true);
    for (const auto& [dj, dk] : steps) {
      const int j = lattice.image(run.j + dj, 0, 1), k = lattice.image(run.k + dk, 0, 2);
      if (j >= cells.j || k >= cells.k) continue;
      const int row = k * cells.j + j;
      for (int m = first_of_row[row]; m < first_of_row[row + 1]; ++m) {
        if (runs[m].phase != run.phase) continue;
        const bool overlap = runs[m].i_begin < run.i_end && runs[m].i_end > run.i_begin;
        const bool meet = overlap || runs[m].i_begin == run.i_end || (goes_over && runs[m].i_begin == 0);
        if (meet) visit(n, m, overlap || dj + dk == 1);
      }
    }
  }
}

/// Joins each class of fewer cells than `least` to one larger class that it is linked to.
void keep_crumbs(const Lattice& lattice, const std::vector<CellRun>& runs,
                 const std::vector<int>& first_of_row, std::size_t least, UnionFind& classes) {
  std::vector<int> class_of_run;
  std::vector<std::size_t> size(classes.number(class_of_run), 0);
  for (std::size_t n = 0; n < runs.size(); ++n) size[class_of_run[n]] += runs[n].i_end - runs[n].i_begin;
  std::vector<char> kept(size.size(), 0);
  for_each_link(lattice, runs, first_of_row, [&](int n, int m, bool) {
    const int a = class_of_run[n], b = class_of_run[m];
    if ((size[a] < least) == (size[b] < least)) return;
    char& done = kept[size[a] < least ? a : b];
    if (!done) classes.join(n, m);
    done = 1;
  });
}

}  // namespace

PhasePieces find_pieces(const Lattice& lattice, const std::vector<mesh::Phase>& winner,
                        const TornBubbles& torn) {
  std::vector<int> first_of_row;
  PhasePieces result{find_runs(lattice.cells, winner, first_of_row), {}};
  auto& runs = result.run;
  UnionFind classes(static_cast<int>(runs.size()));
  const auto is_torn = [&](mesh::Phase p) {
    return std::find(torn.phase.begin(), torn.phase.end(), p) != torn.phase.end();
  };
  for_each_link(lattice, runs, first_of_row, [&](int n, int m, bool is_sure) {
    if (is_sure || !is_torn(runs[n].phase)) classes.join(n, m);
  });
  if (!torn.phase.empty()) keep_crumbs(lattice, runs, first_of_row, torn.least_cells, classes);
  std::vector<int> piece_of_run;
  result.piece.assign(classes.number(piece_of_run), {-1, no_cells(), 0});
  for (std::size_t n = 0; n < runs.size(); ++n) {
    CellRun& run = runs[n];
    run.piece = piece_of_run[n];
    PhasePiece& piece = result.piece[run.piece];
    piece.phase = run.phase;
    piece.cells.include(run.i_begin, run.j, run.k);
    piece.cells.include(run.i_end - 1, run.j, run.k);
    piece.n_cells += run.i_end - run.i_begin;
  }
  return result;
}

bool separate_pieces(PhasePotentials& potentials, const std::vector<mesh::Phase>& winner,
                     state::Phases& phases, double smallest_volume, std::vector<PhaseChange>& changes,
                     const TornBubbles& torn) {
  const Lattice& lattice = potentials.lattice();
  const double h = potentials.h(), cell_volume = h * h * h;
  const PhasePieces pieces = find_pieces(lattice, winner, torn);
  std::map<mesh::Phase, std::vector<int>> of_phase;
  for (std::size_t n = 0; n < pieces.piece.size(); ++n)
    of_phase[pieces.piece[n].phase].push_back(static_cast<int>(n));

  const PieceDistance distance(lattice, winner);
  bool changed = false;
  for (const auto& [phase, members] : of_phase) {
    if (members.size() < 2) continue;
    const int main = main_piece(pieces, members);
    for (int member : members) {
      if (member == main) continue;
      changed = true;
      const PhasePiece& piece = pieces.piece[member];
      const CellBox window = lattice.grown(piece.cells, reach);
      const auto to_piece = distance(pieces, window, [&](int n) { return n == member; });
      const auto to_others =
          distance(pieces, window, [&](int n) { return n != member && pieces.piece[n].phase == phase; });
      const double volume = static_cast<double>(piece.n_cells) * cell_volume;
      if (volume < smallest_volume) {
        // A piece this small has ψ above the second by 2.5 h at most; three h a cell of distance beats that.
        cut_out(*potentials.find(phase), window, to_piece, to_others, 3 * h, phase);
        changes.push_back({PhaseChange::Kind::Absorbed, phase, phase, volume});
      } else {
        const mesh::Phase child = phases.count();
        phases.target_volume.push_back(0);
        potentials.set(cut_out(*potentials.find(phase), window, to_piece, to_others, h, child));
        changes.push_back(
            {phase == 0 ? PhaseChange::Kind::Pocket : PhaseChange::Kind::Split, phase, child, volume});
      }
    }
  }
  return changed;
}

void settle_new_phases(const mesh::FilmMesh& films, const mesh::Topology& topology, state::Phases& phases,
                       std::vector<PhaseChange>& changes, std::size_t first) {
  if (changes.size() == first) return;
  const std::vector<double> volume = smooth_phase_volumes(films, topology, phases.count());
  // A piece that split off may itself have split in a later round: a family is all that came of one phase
  // that was there before, or of one pocket.
  std::map<mesh::Phase, mesh::Phase> ancestor;
  std::map<mesh::Phase, double> family_volume, family_target;
  const auto root_of = [&](mesh::Phase p) {
    const auto found = ancestor.find(p);
    return found == ancestor.end() ? p : found->second;
  };
  for (std::size_t n = first; n < changes.size(); ++n) {
    PhaseChange& c = changes[n];
    if (c.kind == PhaseChange::Kind::Pocket) phases.target_volume[c.other] = c.volume = volume[c.other];
    if (c.kind != PhaseChange::Kind::Split) continue;
    const mesh::Phase root = root_of(c.phase);
    if (family_volume.emplace(root, volume[root]).second) family_target[root] = phases.target_volume[root];
    ancestor[c.other] = root;
    family_volume[root] += volume[c.other];
  }
  for (std::size_t n = first; n < changes.size(); ++n) {
    PhaseChange& c = changes[n];
    if (c.kind != PhaseChange::Kind::Split) continue;
    const mesh::Phase root = root_of(c.phase);
    c.volume = family_target[root] / family_volume[root] * volume[c.other];
    phases.target_volume[c.other] = c.volume;
    phases.target_volume[root] -= c.volume;
  }
}

std::vector<ClosedSurface> closed_surfaces(const mesh::FilmMesh& films, const mesh::Topology& topology) {
  std::vector<int> surface_of_side;
  std::vector<ClosedSurface> surfaces(number_surfaces(films, topology, surface_of_side), {-1, 0, {}, {}, {}});
  std::vector<mesh::Phase> phase(surfaces.size());
  for (int l = 0; l < topology.n_lamellae(); ++l) {
    phase[surface_of_side[2 * l]] = topology.lamella[l].phase_a;
    phase[surface_of_side[2 * l + 1]] = topology.lamella[l].phase_b;
  }
  std::map<mesh::Phase, int> n_surfaces;
  for (mesh::Phase p : phase) ++n_surfaces[p];
  std::vector<char> measured;
  for (mesh::Phase p : phase) measured.push_back(p == 0 || n_surfaces[p] > 1);

  for (int side = 0; side < 2 * films.n_triangles(); ++side) {
    const int surface = surface_of_side[2 * topology.triangle_lamella[side / 2] + side % 2];
    if (!measured[surface]) continue;
    ClosedSurface& s = surfaces[surface];
    const auto corner = films.corners(side / 2);
    if (s.phase < 0) s = {phase[surface], 0, corner[0], corner[0], corner[0]};
    const Vec3 shift = films.domain.near(corner[0], s.start) - corner[0];
    const Vec3 a = corner[0] + shift - s.start, b = corner[1] + shift - s.start,
               c = corner[2] + shift - s.start;
    s.volume += (side % 2 ? -1 : 1) * dot(a, cross(b, c)) / 6;
    for (const Vec3& x : corner)
      for (int d = 0; d < 3; ++d) {
        s.lower[d] = std::min(s.lower[d], x[d] + shift[d]);
        s.upper[d] = std::max(s.upper[d], x[d] + shift[d]);
      }
  }
  std::erase_if(surfaces, [](const ClosedSurface& s) { return s.phase < 0; });
  mark_large(films.domain, surfaces);
  return surfaces;
}

TornBubbles torn_bubbles(double h, const std::vector<ClosedSurface>& surfaces, double smallest_volume) {
  // What was not measured may be another side of one bubble, as of a layer across a periodic box, but not of
  // what a smaller surface encloses.
  std::map<mesh::Phase, int> n_surfaces, n_measured;
  for (const ClosedSurface& s : surfaces) {
    if (s.phase == 0 || s.volume < smallest_volume) continue;
    ++n_surfaces[s.phase];
    if (std::isfinite(s.volume)) ++n_measured[s.phase];
  }
  TornBubbles torn{{}, static_cast<std::size_t>(std::ceil(smallest_volume / (h * h * h)))};
  for (const auto& [phase, n] : n_measured)
    if (n_surfaces[phase] > 1) torn.phase.push_back(phase);
  return torn;
}

int suppress_specks(PhasePotentials& potentials, const std::vector<mesh::Phase>& winner,
                    const std::vector<ClosedSurface>& surfaces, double smallest_volume) {
  const double h = potentials.h();
  std::map<mesh::Phase, double> largest;
  for (const auto& s : surfaces)
    if (s.phase != 0) largest[s.phase] = std::max(largest[s.phase], s.volume);
  int n_specks = 0;
  for (const auto& s : surfaces) {
    if (s.volume <= 0 || s.volume >= smallest_volume || (s.phase != 0 && s.volume == largest[s.phase]))
      continue;
    ++n_specks;
    CellBox around = no_cells();
    for (const Vec3& corner : {s.lower, s.upper}) {
      const Vec3 place = (corner - potentials.box().lower) / h;
      around.include(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)),
                     static_cast<int>(std::floor(place.z)));
    }
    PhaseField& field = *potentials.find(s.phase);
    const CellBox whole = all_cells(potentials.lattice().cells);
    for_each_cell(potentials.lattice().grown(around, 1), [&](int i, int j, int k) {
      const Index3 cell = potentials.lattice().image_in(whole, i, j, k);
      const auto place = field.place(i, j, k);
      if (winner[whole.offset(cell.i, cell.j, cell.k)] != s.phase && place) field.value[*place] -= h;
    });
  }
  return n_specks;
}

}  // namespace spume::interface
