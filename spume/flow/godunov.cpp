#include "spume/flow/godunov.hpp"

#include <algorithm>

#include "spume/flow/slopes.hpp"

namespace spume::flow {

namespace {

/// The value that the wind brings to a face, and the mean of both where there is no wind.
inline double upwind(double wind, double calm, double below, double above) {
  const double mean = 0.5 * (below + above);
  const double blown = wind > 0 ? below : above;
  return std::abs(wind) > calm ? blown : mean;
}

/// The normal velocity of a face between two values of it (the Riemann problem of Burgers' equation): none
/// where the two sides part or balance.
inline double normal_velocity(double calm, double below, double above) {
  const double mean = 0.5 * (below + above);
  const double blown = mean > 0 ? below : above;
  const bool parts = below <= 0 && above >= 0;
  return parts || std::abs(mean) <= calm ? 0.0 : blown;
}

/// Values at faces traced along their axis alone; s is the stride of cells, ts that of the tile along the
/// axis, ratio = Δt/h. Face c of the cells is face t of the tile.
struct NormalTrace {
  const double *value, *speed, *slope;
  double ratio;
  std::ptrdiff_t s, ts;

  double below(std::ptrdiff_t c, std::ptrdiff_t t) const {
    return value[c - s] + 0.5 * (1 - speed[c - s] * ratio) * slope[t - ts];
  }
  double above(std::ptrdiff_t c, std::ptrdiff_t t) const {
    return value[c] - 0.5 * (1 + speed[c] * ratio) * slope[t];
  }
};

/// The two values at a face at tⁿ + ½Δt, with what accelerates them and the derivatives across the other two
/// axes.
struct FaceStates {
  NormalTrace trace;
  const double *acceleration, *transverse_1, *transverse_2;
  double half_dt;

  double change(std::ptrdiff_t c, std::ptrdiff_t t) const {
    return half_dt * (acceleration[c] - transverse_1[t] - transverse_2[t]);
  }
  double below(std::ptrdiff_t c, std::ptrdiff_t t) const {
    return trace.below(c, t) + change(c - trace.s, t - trace.ts);
  }
  double above(std::ptrdiff_t c, std::ptrdiff_t t) const { return trace.above(c, t) + change(c, t); }
};

}  // namespace

/// What a step is computed from; pointers to the first owned cell.
struct Godunov::Known {
  std::array<const double*, 3> velocity, acceleration;
  double dt, h, calm;
  bool limit;
};

/// Work values of a box of cells and one layer around it.
struct Godunov::Tile {
  /// Cells along y and z: small enough for the work values to stay in cache with rows of some hundred
  /// cells, large enough that the layer around the tile, which is computed twice, stays cheap.
  static constexpr int ny = 16, nz = 16;

  explicit Tile(const BlockLayout& block_) : block(block_) {
    stride = {1, (block.owned().upper.i + 2 + 7) / 8 * 8, 0};
    stride[2] = stride[1] * (ny + 2);
    for (auto* arrays : {&slope, &normal_slope, &wind, &transverse, &face})
      for (auto& values : *arrays) values.assign(static_cast<std::size_t>(stride[2]) * (nz + 2), 0.0);
    for (auto& row : difference) row.assign(stride[1] + 2, 0.0);
  }

  std::ptrdiff_t offset(int i, int j, int k) const {
    return (k - cells.lower.k + 1) * stride[2] + (j - cells.lower.j + 1) * stride[1] + i + 1;
  }
  /// Calls body(c, t, n) for every row along x of `range`: cells c … c + n − 1 of the block are t … of the
  /// tile.
  template <class Body>
  void for_each_row(const CellRange& range, Body&& body) const {
    for (int k = range.lower.k; k < range.upper.k; ++k)
      for (int j = range.lower.j; j < range.upper.j; ++j)
        body(block.offset(range.lower.i, j, k), offset(range.lower.i, j, k), range.upper.i - range.lower.i);
  }

  NormalTrace trace(const Known& known, int component, int axis) const {
    const double* of_axis = component == axis ? normal_slope[axis].data() : slope[axis].data();
    return {known.velocity[component], known.velocity[axis], of_axis,
            known.dt / known.h,        block.stride(axis),   stride[axis]};
  }
  FaceStates face_states(const Known& known, int component, int axis) const {
    return {trace(known, component, axis), known.acceleration[component], transverse[(axis + 1) % 3].data(),
            transverse[(axis + 2) % 3].data(), 0.5 * known.dt};
  }

  void find_slopes(const Known& known, int component, int axis, std::vector<double>& values);
  void trace_winds(const Known& known);
  void find_transverse_terms(const Known& known, int component, int axis);

  const BlockLayout& block;
  CellRange cells;
  std::array<std::ptrdiff_t, 3> stride;
  using Arrays = std::array<std::vector<double>, 3>;  ///< one an axis
  Arrays difference;    ///< of three rows: of the cells across the axis of a slope [m/s]
  Arrays slope;         ///< h ∂u_c/∂x_axis of the component at work, but for the axis c [m/s]
  Arrays normal_slope;  ///< h ∂u_axis/∂x_axis [m/s]
  Arrays wind;          ///< on faces across the axis [m/s]
  Arrays transverse;    ///< u_axis ∂u_c/∂x_axis of the component at work [m/s²]
  Arrays face;          ///< values or fluxes on faces across the axis
};

void Godunov::Tile::find_slopes(const Known& known, int component, int axis, std::vector<double>& values) {
  const CellRange range = cells.grown(1);
  const std::ptrdiff_t n = range.upper.i - range.lower.i, s = block.stride(axis);
  const double* u = known.velocity[component];
  if (axis == 0) {
    for_each_row(range, [&](std::ptrdiff_t c, std::ptrdiff_t t, std::ptrdiff_t) {
      double* delta = difference[0].data();
      central_differences(n + 2, s, known.limit, u + c - 1, delta);
      slopes_from_differences(n, s, known.limit, u + c, delta, delta + 2, values.data() + t);
    });
    return;
  }
  // Rows one after another along the axis, each with the differences of the two before it.
  const int other = 3 - axis;
  for (int m = range.lower[other]; m < range.upper[other]; ++m)
    for (int l = range.lower[axis] - 1; l <= range.upper[axis]; ++l) {
      Index3 cell{range.lower.i, 0, 0};
      cell[other] = m;
      cell[axis] = l;
      const std::ptrdiff_t c = block.offset(cell.i, cell.j, cell.k);
      const auto delta = [&](int row) { return difference[(row + 3) % 3].data(); };
      central_differences(n, s, known.limit, u + c, delta(l));
      if (l < range.lower[axis] + 1) continue;
      cell[axis] = l - 1;
      slopes_from_differences(n, s, known.limit, u + c - s, delta(l - 2), delta(l),
                              values.data() + offset(cell.i, cell.j, cell.k));
    }
}

/// The wind for the transverse terms: normal velocities traced along their own axis, on the faces of the tile
/// and one layer around them across the other axes.
void Godunov::Tile::trace_winds(const Known& known) {
  const double calm = known.calm;
  for (int axis = 0; axis < 3; ++axis) {
    find_slopes(known, axis, axis, normal_slope[axis]);
    const NormalTrace traced = trace(known, axis, axis);
    double* normal = wind[axis].data();
    for_each_row(
        cells.grown(1).grown(axis, -1, 0), [=](std::ptrdiff_t c, std::ptrdiff_t t, std::ptrdiff_t n) {
#pragma GCC ivdep
          for (std::ptrdiff_t i = 0; i < n; ++i)
            normal[t + i] = normal_velocity(calm, traced.below(c + i, t + i), traced.above(c + i, t + i));
        });
  }
}

/// u_axis ∂u_c/∂x_axis of cells from upwind values traced along the axis alone, of the tile and one layer
/// around it across the other axes.
void Godunov::Tile::find_transverse_terms(const Known& known, int component, int axis) {
  if (component != axis) find_slopes(known, component, axis, slope[axis]);
  const NormalTrace traced = trace(known, component, axis);
  const double calm = known.calm, scale = 0.5 / known.h;
  const double* normal = wind[axis].data();
  double *value = face[axis].data(), *term = transverse[axis].data();
  const CellRange range = cells.grown(1).grown(axis, -1, -1);
  for_each_row(range.grown(axis, 0, 1), [=](std::ptrdiff_t c, std::ptrdiff_t t, std::ptrdiff_t n) {
#pragma GCC ivdep
    for (std::ptrdiff_t i = 0; i < n; ++i)
      value[t + i] = upwind(normal[t + i], calm, traced.below(c + i, t + i), traced.above(c + i, t + i));
  });
  const std::ptrdiff_t s = stride[axis];
  for_each_row(range, [=](std::ptrdiff_t, std::ptrdiff_t row, std::ptrdiff_t n) {
#pragma GCC ivdep
    for (std::ptrdiff_t t = row; t < row + n; ++t)
      term[t] = scale * (normal[t] + normal[t + s]) * (value[t + s] - value[t]);
  });
}

Godunov::Godunov(const grid::Grid& grid, bool limit_slopes)
    : grid_(grid),
      layout_(grid),
      limit_(limit_slopes),
      face_velocity_(block_vector(layout_)),
      tile_(std::make_unique<Tile>(layout_)) {}

Godunov::~Godunov() = default;

Godunov::Known Godunov::known(const GhostedVector& u, const BlockVector& acceleration, double dt) const {
  Known known{{}, {}, dt, grid_.h(), calm_, limit_};
  for (int c = 0; c < 3; ++c) {
    known.velocity[c] = first(u[c], grid_);
    known.acceleration[c] = acceleration[c].first();
  }
  return known;
}

/// Calls body() with tile_ on one box of owned cells after another.
template <class Body>
void Godunov::for_each_tile(Body&& body) {
  const CellRange owned = layout_.owned();
  for (int k = 0; k < owned.upper.k; k += Tile::nz)
    for (int j = 0; j < owned.upper.j; j += Tile::ny) {
      tile_->cells = {
          {0, j, k},
          {owned.upper.i, std::min(j + Tile::ny, owned.upper.j), std::min(k + Tile::nz, owned.upper.k)}};
      body();
    }
}

void Godunov::predict_normals(const GhostedVector& u, const BlockVector& acceleration, double speed,
                              double dt) {
  const double calm = calm_ = 1e-10 * speed;
  const Known known = this->known(u, acceleration, dt);
  for_each_tile([&] {
    tile_->trace_winds(known);
    for (int axis = 0; axis < 3; ++axis) {
      for (int e = 0; e < 3; ++e)
        if (e != axis) tile_->find_transverse_terms(known, axis, e);
      const FaceStates states = tile_->face_states(known, axis, axis);
      double* normal = face_velocity_[axis].first();
      tile_->for_each_row(
          tile_->cells.grown(axis, 0, 1), [=](std::ptrdiff_t c, std::ptrdiff_t t, std::ptrdiff_t n) {
#pragma GCC ivdep
            for (std::ptrdiff_t i = 0; i < n; ++i)
              normal[c + i] = normal_velocity(calm, states.below(c + i, t + i), states.above(c + i, t + i));
          });
    }
  });
  close_walls();
}

void Godunov::close_walls() {
  const int nz = grid_.cells().k;
  for (int axis = 0; axis < 3; ++axis) {
    if (grid_.box().boundary[axis] == grid::Boundary::Periodic) continue;
    double* normal = face_velocity_[axis].first();
    CellRange lower = layout_.owned(), upper = layout_.owned();
    const int end = upper.upper[axis];
    lower.upper[axis] = 1;
    upper.lower[axis] = end;
    upper.upper[axis] = end + 1;
    const auto close = [=](std::ptrdiff_t row, std::ptrdiff_t n) { std::fill_n(normal + row, n, 0.0); };
    if (axis != 2 || grid_.z_begin() == 0) for_each_row(layout_, lower, close);
    if (axis != 2 || grid_.z_end() == nz) for_each_row(layout_, upper, close);
  }
}

/// Calls store(component, c, n, divergence) for every row of owned cells, `divergence` that of the fluxes.
template <class Store>
void Godunov::advect_each_row(const GhostedVector& u, const BlockVector& acceleration, double dt,
                              Store&& store) {
  const Known known = this->known(u, acceleration, dt);
  const double calm = calm_, per_h = 1 / grid_.h();
  for_each_tile([&] {
    tile_->trace_winds(known);
    for (int component = 0; component < 3; ++component) {
      for (int e = 0; e < 3; ++e) tile_->find_transverse_terms(known, component, e);
      for (int axis = 0; axis < 3; ++axis) {
        const FaceStates states = tile_->face_states(known, component, axis);
        const double* normal = face_velocity_[axis].first();
        double* flux = tile_->face[axis].data();
        tile_->for_each_row(
            tile_->cells.grown(axis, 0, 1), [=](std::ptrdiff_t c, std::ptrdiff_t t, std::ptrdiff_t n) {
#pragma GCC ivdep
              for (std::ptrdiff_t i = 0; i < n; ++i)
                flux[t + i] = normal[c + i] * upwind(normal[c + i], calm, states.below(c + i, t + i),
                                                     states.above(c + i, t + i));
            });
      }
      const double *x = tile_->face[0].data(), *y = tile_->face[1].data(), *z = tile_->face[2].data();
      const std::ptrdiff_t sy = tile_->stride[1], sz = tile_->stride[2];
      tile_->for_each_row(tile_->cells, [=](std::ptrdiff_t c, std::ptrdiff_t row, std::ptrdiff_t n) {
        store(component, c, n, [=](std::ptrdiff_t i) {
          const std::ptrdiff_t t = row + i;
          return per_h * (x[t + 1] - x[t]) + per_h * (y[t + sy] - y[t]) + per_h * (z[t + sz] - z[t]);
        });
      });
    }
  });
}

void Godunov::advect(const GhostedVector& u, const BlockVector& acceleration, double dt,
                     grid::VectorField& advection) {
  advect_each_row(u, acceleration, dt,
                  [&](int component, std::ptrdiff_t c, std::ptrdiff_t n, auto&& divergence) {
                    double* row = advection[component].values().data() + layout_.place(c);
#pragma GCC ivdep
                    for (std::ptrdiff_t i = 0; i < n; ++i) row[i] = divergence(i);
                  });
}

void Godunov::accelerate(const GhostedVector& u, const BlockVector& acceleration, double dt,
                         grid::VectorField& rate) {
  advect_each_row(u, acceleration, dt,
                  [&](int component, std::ptrdiff_t c, std::ptrdiff_t n, auto&& divergence) {
                    double* row = rate[component].values().data() + layout_.place(c);
                    const double* a = acceleration[component].first() + c;
#pragma GCC ivdep
                    for (std::ptrdiff_t i = 0; i < n; ++i) row[i] = a[i] - divergence(i);
                  });
}

}  // namespace spume::flow
