#include "spume/interface/contour.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/interface/contour_parts.hpp"
#include "spume/interface/field_bins.hpp"
#include "spume/interface/mixed_cubes.hpp"

namespace spume::interface {

namespace {

constexpr int max_near = 128;       // fields that have values at a cube
constexpr int max_candidates = 24;  // of them, those that may win somewhere in it
constexpr int max_corners = 4 + max_candidates;

/// The six ways from a cube's lowest to its highest corner, one axis at a time: the Kuhn tetrahedra. The
/// first three are even permutations, whose tetrahedra are positively oriented.
constexpr std::array<std::array<int, 3>, 6> axis_orders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

/// A corner of a film's polygon in a tetrahedron, and the side to the next corner: 0 … 3 the face of the
/// tetrahedron opposite that corner of it, 4 + c the clipping by candidate c.
struct Corner {
  std::array<double, 4> weight;
  int side;
};
struct Polygon {
  std::array<Corner, max_corners> corner;
  int n = 0;
  bool reversed = false;
};

/// The triangles that the faces of a cube are cut into, seen from outside; their diagonals are those of the
/// Kuhn tetrahedra, from the lowest corner of a face to its highest.
constexpr std::array<std::array<int, 3>, 12> face_triangles{{{0, 4, 6},
                                                             {0, 6, 2},
                                                             {1, 7, 5},
                                                             {1, 3, 7},
                                                             {0, 5, 4},
                                                             {0, 1, 5},
                                                             {2, 6, 7},
                                                             {2, 7, 3},
                                                             {0, 3, 1},
                                                             {0, 2, 3},
                                                             {4, 5, 7},
                                                             {4, 7, 6}}};

/// What the corners of a cube say about its films.
enum class CubeKind : std::uint8_t { Empty, OneFilm, Several };

/// Number of pairs out of order: its parity is that of the permutation.
bool is_odd(const std::array<int, 4>& order) {
  int inversions = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b) inversions += order[a] > order[b];
  return inversions & 1;
}

class Contourer {
 public:
  Contourer(const PhasePotentials& potentials, const std::vector<mesh::Phase>& winner, Pieces pieces)
      : potentials_(potentials),
        pieces_(pieces),
        cubes_(potentials.lattice(), winner),
        bins_(potentials),
        whole_(all_cells(potentials.box().cells)) {
    films_.domain = potentials.box().domain();
  }

  std::vector<int> shares_of_layers(int n_shares) { return cubes_.shares_of_layers(n_shares); }

  /// The films of the layers of cubes from `begin` to before `end`.
  ContourPart run(int begin, int end) {
    begin_ = begin;
    end_ = end;
    const int n_layers = cubes_.end().k;
    kind_.assign(whole_.size(), CubeKind::Empty);
    // A cube looks at its neighbours, too.
    for (int k = begin - 1; k <= end; ++k) {
      const int layer = potentials_.lattice().image(k, 0, 2);
      if (layer >= 0 && layer < n_layers)
        for_each_mixed_cube(layer, [&](CubeKind& kind) { kind = kind_of_cube(); });
    }
    for (int k = begin; k < end; ++k)
      for_each_mixed_cube(k, [&](CubeKind& kind) {
        if (kind == CubeKind::OneFilm)
          contour_one_film();
        else
          contour_tetrahedra();
      });
    return {std::move(films_), std::move(seam_)};
  }

 private:
  template <class Body>
  void for_each_mixed_cube(int k, Body&& body) {
    cubes_.for_each_in_layer(k, [&](const Index3& cube) {
      cube_ = cube;
      cube_winner_ = cubes_.winners_of(cube);
      body(kind_[whole_.offset(cube.i, cube.j, cube.k)]);
    });
  }
  CubeKind kind_of_cube() {
    if (pieces_ == Pieces::OfTetrahedra || !are_two_phases(cube_winner_) || has_ambiguous_face(cube_winner_))
      return CubeKind::Several;
    find_candidates();
    return n_cube_ == 2 ? CubeKind::OneFilm : CubeKind::Several;
  }
  static std::array<double, 8> values_of_cube(const PhaseField& field, int i, int j, int k) {
    const Index3 c = field.lattice.image_in(field.cells, i, j, k);
    std::array<double, 8> value;
    if (field.cells.contains(c.i + 1, c.j + 1, c.k + 1)) {
      const double* v = &field.value[field.cells.offset(c.i, c.j, c.k)];
      const std::ptrdiff_t y = field.cells.stride_y(), z = field.cells.stride_z();
      value = {v[0], v[1], v[y], v[y + 1], v[z], v[z + 1], v[z + y], v[z + y + 1]};
    } else {
      for (int m = 0; m < 8; ++m) value[m] = field.at(i + (m & 1), j + (m >> 1 & 1), k + (m >> 2));
    }
    return value;
  }
  /// The film of two phases in a cube where no other competes: closed lines on the faces of the cube, filled.
  /// On faces to cubes with several films the lines have the corners of the tetrahedra there, elsewhere only
  /// those on the edges of the cube.
  void contour_one_film() {
    const auto [low, high] = std::minmax_element(cube_winner_.begin(), cube_winner_.end());
    cube_phase_[0] = *low;
    cube_phase_[1] = *high;
    for (int c = 0; c < 2; ++c)
      cube_value_[c] = values_of_cube(*potentials_.find(cube_phase_[c]), cube_.i, cube_.j, cube_.k);
    std::array<double, 8> excess;  // of the first phase
    for (int c = 0; c < 8; ++c) excess[c] = cube_value_[0][c] - cube_value_[1][c];
    constexpr int none = -1;
    const auto edge_of = [](int p, int q) { return std::min(p, q) * 8 + std::max(p, q); };
    std::array<int, 64> next;  // edge of the cube or of a diagonal → the one that follows along a line
    next.fill(none);
    for (const auto& corner : face_triangles) {
      int leaves = none, enters = none;  // the first phase
      for (int c = 0; c < 3; ++c) {
        const int p = corner[c], q = corner[(c + 1) % 3];
        if ((excess[p] >= 0) == (excess[q] >= 0)) continue;
        (excess[p] >= 0 ? leaves : enters) = edge_of(p, q);
      }
      if (leaves != none) next[enters] = leaves;
    }
    for (int first = 0; first < 64; ++first) {
      if (next[first] == none) continue;
      std::array<int, 18> v;  // twelve edges and six diagonals
      int n = 0;
      for (int edge = first; next[edge] != none;) {
        if (!is_left_out(edge / 8, edge % 8)) v[n++] = vertex_on_edge(edge / 8, edge % 8, excess);
        edge = std::exchange(next[edge], none);
      }
      fill_polygon(v.data(), n, cube_phase_[0], cube_phase_[1]);
    }
  }
  /// Whether a diagonal of a face needs no vertex: none of the cubes on both sides has several films.
  bool is_left_out(int low, int high) const {
    const int across = 7 & ~(low ^ high);  // the bit of the axis across the face
    if (!std::has_single_bit(static_cast<unsigned>(across))) return false;
    const int axis = std::countr_zero(static_cast<unsigned>(across));
    Index3 beyond = cube_;
    beyond[axis] += low & across ? 1 : -1;
    beyond[axis] = potentials_.lattice().image(beyond[axis], 0, axis);
    return !whole_.contains(beyond.i, beyond.j, beyond.k) ||
           kind_[whole_.offset(beyond.i, beyond.j, beyond.k)] != CubeKind::Several;
  }
  int vertex_on_edge(int low, int high, const std::array<double, 8>& excess) {
    const VertexKey key{cubes_.lattice_point(cube_, low) << 9 | static_cast<unsigned>(low ^ high),
                        {cube_phase_[0], cube_phase_[1], -1, -1}};
    const int number = number_of(key);
    if (number == films_.n_vertices()) {
      const double s = excess[low] == excess[high] ? 0.5 : excess[low] / (excess[low] - excess[high]);
      Vec3 place{cube_.i + 0.5, cube_.j + 0.5, cube_.k + 0.5};
      for (int d = 0; d < 3; ++d) place[d] += (1 - s) * (low >> d & 1) + s * (high >> d & 1);
      films_.position.push_back(potentials_.box().lower + potentials_.h() * place);
    }
    return number;
  }

  void contour_tetrahedra() {
    find_candidates();
    for (int t = 0; t < 6; ++t) {
      const auto& axis = axis_orders[t];
      mask_ = {0, 1 << axis[0], (1 << axis[0]) | (1 << axis[1]), 7};
      const mesh::Phase w = cube_winner_[0];
      if (cube_winner_[mask_[1]] == w && cube_winner_[mask_[2]] == w && cube_winner_[7] == w) continue;
      positive_ = t < 3;
      find_tetrahedron_candidates();
      for (int a = 0; a < n_; ++a)
        for (int b = a + 1; b < n_; ++b) contour_film(a, b);
    }
  }

  /// Phases with values at all eight corners that no winner beats at all of them.
  void find_candidates() {
    const auto [i, j, k] = cube_;
    n_cube_ = 0;
    for (const PhaseField* field : bins_.at(i, j, k)) {
      if (!field->place(i, j, k) || !field->place(i + 1, j + 1, k + 1)) continue;
      if (n_cube_ == max_near) throw NumericalError("more than 128 phases are near one cell");
      cube_value_[n_cube_] = values_of_cube(*field, i, j, k);
      cube_phase_[n_cube_++] = field->phase;
    }
    std::array<int, 8> winners;  // their places among the candidates
    int n_winners = 0;
    for (int a = 0; a < n_cube_; ++a)
      if (std::find(cube_winner_.begin(), cube_winner_.end(), cube_phase_[a]) != cube_winner_.end())
        winners[n_winners++] = a;
    const auto is_beaten = [&](int a) {
      for (int w = 0; w < n_winners; ++w) {
        int n_below = 0;
        for (int c = 0; c < 8; ++c) n_below += cube_value_[a][c] < cube_value_[winners[w]][c];
        if (n_below == 8) return true;
      }
      return false;
    };
    std::array<bool, max_near> beaten;
    for (int a = 0; a < n_cube_; ++a) beaten[a] = is_beaten(a);
    int n = 0;
    for (int a = 0; a < n_cube_; ++a) {
      if (beaten[a]) continue;
      cube_phase_[n] = cube_phase_[a];
      cube_value_[n++] = cube_value_[a];
    }
    if (n > max_candidates) throw NumericalError("more than 24 phases compete for one cell");
    n_cube_ = n;
  }

  /// The same for the four corners of a tetrahedron.
  void find_tetrahedron_candidates() {
    n_ = 0;
    // Of two, each wins somewhere here: a tetrahedron of one winner is not looked at.
    const bool both = n_cube_ == 2;
    for (int a = 0; a < n_cube_; ++a) {
      bool beaten = false;
      for (int w = 0; w < n_cube_ && !beaten && !both; ++w) {
        if (w == a) continue;
        bool wins = false, below = true;
        for (int m : mask_) {
          wins = wins || cube_winner_[m] == cube_phase_[w];
          below = below && cube_value_[a][m] < cube_value_[w][m];
        }
        beaten = wins && below;
      }
      if (beaten) continue;
      for (int c = 0; c < 4; ++c) value_[n_][c] = cube_value_[a][mask_[c]];
      phase_[n_++] = cube_phase_[a];
    }
  }

  void contour_film(int a, int b) {
    Polygon polygon;
    if (!cut(a, b, polygon)) return;
    for (int c = 0; c < n_ && polygon.n > 0; ++c)
      if (c != a && c != b) clip(a, b, c, polygon);
    if (polygon.n >= 3) triangulate(a, b, polygon);
  }

  /// {ψ_a = ψ_b} in the tetrahedron: a triangle or a quadrilateral, its normal from a to b. Ties go to a.
  bool cut(int a, int b, Polygon& polygon) const {
    std::array<double, 4> d;
    std::array<bool, 4> is_a;
    int n_a = 0;
    for (int c = 0; c < 4; ++c) {
      d[c] = value_[a][c] - value_[b][c];
      is_a[c] = d[c] >= 0;
      n_a += is_a[c];
    }
    if (n_a == 0 || n_a == 4) return false;
    const auto crossing = [&](int from, int to, int side) {
      Corner corner{{}, side};
      const double s = d[from] == d[to] ? 0.5 : d[from] / (d[from] - d[to]);
      corner.weight[from] = 1 - s;
      corner.weight[to] = s;
      return corner;
    };
    std::array<int, 4> o;
    int filled = 0;
    // One corner against three: the lonely one first; two against two: those of a first.
    const bool first_side = n_a != 3;
    for (int c = 0; c < 4; ++c)
      if (is_a[c] == first_side) o[filled++] = c;
    for (int c = 0; c < 4; ++c)
      if (is_a[c] != first_side) o[filled++] = c;
    polygon.reversed = positive_ == is_odd(o);
    if (n_a == 2) {
      polygon.n = 4;
      polygon.corner[0] = crossing(o[0], o[2], o[1]);
      polygon.corner[1] = crossing(o[0], o[3], o[2]);
      polygon.corner[2] = crossing(o[1], o[3], o[0]);
      polygon.corner[3] = crossing(o[1], o[2], o[3]);
    } else {
      polygon.n = 3;
      if (n_a == 3) polygon.reversed = !polygon.reversed;
      polygon.corner[0] = crossing(o[0], o[1], o[3]);
      polygon.corner[1] = crossing(o[0], o[2], o[1]);
      polygon.corner[2] = crossing(o[0], o[3], o[2]);
    }
    return true;
  }

  /// Keeps the part of the polygon where ½(ψ_a + ψ_b) ≥ ψ_c.
  void clip(int a, int b, int c, Polygon& polygon) const {
    std::array<double, max_corners> excess;
    bool any_below = false;
    for (int m = 0; m < polygon.n; ++m) {
      excess[m] = 0;
      for (int v = 0; v < 4; ++v)
        excess[m] += polygon.corner[m].weight[v] * (0.5 * (value_[a][v] + value_[b][v]) - value_[c][v]);
      any_below = any_below || excess[m] < 0;
    }
    if (!any_below) return;
    std::array<Corner, max_corners> kept;
    int n = 0;
    for (int m = 0; m < polygon.n; ++m) {
      const int next = (m + 1) % polygon.n;
      const bool in = excess[m] >= 0, next_in = excess[next] >= 0;
      if (in) kept[n++] = polygon.corner[m];
      if (in == next_in) continue;
      const double s = excess[m] / (excess[m] - excess[next]);
      Corner corner;
      for (int v = 0; v < 4; ++v)
        corner.weight[v] = (1 - s) * polygon.corner[m].weight[v] + s * polygon.corner[next].weight[v];
      corner.side = in ? 4 + c : polygon.corner[m].side;
      kept[n++] = corner;
    }
    polygon.n = n;
    std::copy(kept.begin(), kept.begin() + n, polygon.corner.begin());
  }

  void triangulate(int a, int b, const Polygon& polygon) {
    std::array<int, max_corners> v;
    int n = 0;
    for (int m = 0; m < polygon.n; ++m) {
      const int next = vertex(a, b, polygon, m);
      if (n == 0 || next != v[n - 1]) v[n++] = next;
    }
    while (n > 1 && v[n - 1] == v[0]) --n;
    if (polygon.reversed) std::reverse(v.begin(), v.begin() + n);
    fill_polygon(v.data(), n, phase_[a], phase_[b]);
  }

  /// Cuts a polygon into triangles between phases p and q by its shortest diagonals.
  void fill_polygon(int* v, int n, mesh::Phase p, mesh::Phase q) {
    if (n < 3) return;
    const auto add = [&](int first, int second, int third) {
      films_.triangle.push_back({{first, second, third}, p, q});
    };
    for (; n > 3; --n) {
      int ear = 0;
      double shortest = -1;
      for (int m = 0; m < n; ++m) {
        const double l = norm_squared(films_.edge(v[(m + n - 1) % n], v[(m + 1) % n]));
        // Equals but for round-off, of which ranks may have their own: the first.
        if (shortest >= 0 && l >= (1 - 1e-9) * shortest) continue;
        shortest = l;
        ear = m;
      }
      add(v[(ear + n - 1) % n], v[ear], v[(ear + 1) % n]);
      std::copy(v + ear + 1, v + n, v + ear);
    }
    add(v[0], v[1], v[2]);
  }

  /// The number of a vertex, one more than the last if it is new; it is noted if it may be one of the
  /// neighbouring layers of cubes, too.
  int number_of(const VertexKey& key) {
    constexpr std::uint64_t steps_along_z = 0b100100100;
    const int number = vertex_of_.find_or_insert(key, films_.n_vertices());
    if (number == films_.n_vertices() && !(key.simplex & steps_along_z)) {
      const int k = static_cast<int>((key.simplex >> 9) / static_cast<std::uint64_t>(whole_.stride_z()));
      if (k == begin_ || k == potentials_.lattice().image(end_, 0, 2)) seam_.push_back({key, number});
    }
    return number;
  }

  /// Number of the vertex at a corner of the polygon; a new one unless its key is known.
  int vertex(int a, int b, const Polygon& polygon, int corner) {
    unsigned in_simplex = 15;
    mesh::PhaseSet phases{phase_[a], phase_[b]};
    for (int m : {(corner + polygon.n - 1) % polygon.n, corner}) {
      const int side = polygon.corner[m].side;
      if (side < 4)
        in_simplex &= ~(1u << side);
      else
        phases.insert(phase_[side - 4]);
    }
    const int lowest = std::countr_zero(in_simplex);
    std::uint64_t chain = 0;
    int n_steps = 0;
    for (int c = lowest + 1; c < 4; ++c)
      if (in_simplex >> c & 1)
        chain |= static_cast<std::uint64_t>(mask_[c] ^ mask_[lowest]) << (3 * n_steps++);
    VertexKey key{cubes_.lattice_point(cube_, mask_[lowest]) << 9 | chain, {-1, -1, -1, -1}};
    std::copy(phases.begin(), phases.end(), key.phases.begin());
    const int number = number_of(key);
    if (number == films_.n_vertices()) films_.position.push_back(position(polygon.corner[corner]));
    return number;
  }

  Vec3 position(const Corner& corner) const {
    Vec3 place{cube_.i + 0.5, cube_.j + 0.5, cube_.k + 0.5};
    for (int c = 0; c < 4; ++c)
      for (int d = 0; d < 3; ++d)
        if (mask_[c] >> d & 1) place[d] += corner.weight[c];
    return potentials_.box().lower + potentials_.h() * place;
  }

  const PhasePotentials& potentials_;
  Pieces pieces_;
  MixedCubes cubes_;
  FieldBins bins_;
  CellBox whole_;
  int begin_ = 0, end_ = 0;
  mesh::FilmMesh films_;
  std::vector<SeamVertex> seam_;
  VertexNumbers vertex_of_;
  std::vector<CubeKind> kind_;  ///< of the cube above each lattice point

  // of the cube
  Index3 cube_;
  CubeWinners cube_winner_;
  int n_cube_ = 0;
  std::array<mesh::Phase, max_near> cube_phase_;
  std::array<std::array<double, 8>, max_near> cube_value_;
  // of the tetrahedron
  std::array<int, 4> mask_;  ///< corners of the cube along the chain
  bool positive_ = true;
  int n_ = 0;
  std::array<mesh::Phase, max_candidates> phase_;
  std::array<std::array<double, 4>, max_candidates> value_;
};

}  // namespace

mesh::FilmMesh contour(const parallel::Communicator& ranks, const PhasePotentials& potentials,
                       const std::vector<mesh::Phase>& winner, Pieces pieces) {
  ContourPart part;
  ranks.together([&] {
    Contourer contourer(potentials, winner, pieces);
    const auto share = contourer.shares_of_layers(ranks.size());
    part = contourer.run(share[ranks.rank()], share[ranks.rank() + 1]);
  });
  return joined(ranks, std::move(part));
}

}  // namespace spume::interface
