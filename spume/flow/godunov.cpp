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

/// Calls body(slab) for slabs of a few planes of `range`, so that what is written for one is still in cache
/// when it is read for the next term.
template <class Body>
void for_each_slab(const CellRange& range, Body&& body) {
  constexpr int planes = 4;
  for (int k = range.lower.k; k < range.upper.k; k += planes) {
    CellRange slab = range;
    slab.lower.k = k;
    slab.upper.k = std::min(k + planes, range.upper.k);
    body(slab);
  }
}

std::array<BlockVector, 3> block_matrix(const BlockLayout& layout) {
  return {block_vector(layout), block_vector(layout), block_vector(layout)};
}

}  // namespace

/// Values at faces traced along their axis alone, s the stride along it and ratio = Δt/h.
struct Godunov::NormalTrace {
  const double *value, *slope, *speed;
  double ratio;
  std::ptrdiff_t s;

  double below(std::ptrdiff_t c) const {
    return value[c - s] + 0.5 * (1 - speed[c - s] * ratio) * slope[c - s];
  }
  double above(std::ptrdiff_t c) const { return value[c] - 0.5 * (1 + speed[c] * ratio) * slope[c]; }
};

/// The two values at a face at tⁿ + ½Δt, with what accelerates them and the derivatives across the other two
/// axes.
struct Godunov::FaceStates {
  NormalTrace trace;
  const double *acceleration, *transverse_1, *transverse_2;
  double half_dt;

  double change(std::ptrdiff_t c) const {
    return half_dt * (acceleration[c] - transverse_1[c] - transverse_2[c]);
  }
  double below(std::ptrdiff_t c) const { return trace.below(c) + change(c - trace.s); }
  double above(std::ptrdiff_t c) const { return trace.above(c) + change(c); }
};

Godunov::Godunov(const grid::Grid& grid, bool limit_slopes)
    : grid_(grid),
      layout_(grid),
      limit_(limit_slopes),
      slope_(block_matrix(layout_)),
      transverse_(block_matrix(layout_)),
      face_velocity_(block_vector(layout_)),
      face_(layout_) {}

void Godunov::predict_normals(const GhostedVector& u, const BlockVector& acceleration, double speed,
                              double dt) {
  calm_ = 1e-10 * speed;
  for (int c = 0; c < 3; ++c)
    for (int axis = 0; axis < 3; ++axis)
      slopes(layout_, layout_.owned().grown(1), axis, limit_, first(u[c], grid_), slope_[c][axis].first());
  trace_normals(u, dt);
  transverse_terms(u, dt);
  const double calm = calm_;
  for (int axis = 0; axis < 3; ++axis) {
    const FaceStates states = face_states(u, acceleration, axis, axis, dt);
    double* normal = face_velocity_[axis].first();
    for_each_row(layout_, layout_.owned_faces(axis), [=](std::ptrdiff_t row, std::ptrdiff_t n) {
#pragma GCC ivdep
      for (std::ptrdiff_t c = row; c < row + n; ++c)
        normal[c] = normal_velocity(calm, states.below(c), states.above(c));
    });
  }
  close_walls();
}

Godunov::NormalTrace Godunov::normal_trace(const GhostedVector& u, int component, int axis, double dt) const {
  return {first(u[component], grid_), slope_[component][axis].first(), first(u[axis], grid_), dt / grid_.h(),
          layout_.stride(axis)};
}

Godunov::FaceStates Godunov::face_states(const GhostedVector& u, const BlockVector& acceleration,
                                         int component, int axis, double dt) const {
  return {normal_trace(u, component, axis, dt), acceleration[component].first(),
          transverse_[component][(axis + 1) % 3].first(), transverse_[component][(axis + 2) % 3].first(),
          0.5 * dt};
}

/// The wind for the transverse terms: normal velocities traced along their own axis, on the owned faces and
/// one layer around them across the other axes.
void Godunov::trace_normals(const GhostedVector& u, double dt) {
  const double calm = calm_;
  for (int axis = 0; axis < 3; ++axis) {
    const NormalTrace trace = normal_trace(u, axis, axis, dt);
    double* normal = face_velocity_[axis].first();
    const CellRange faces = layout_.owned().grown(1).grown(axis, -1, 0);
    for_each_row(layout_, faces, [=](std::ptrdiff_t row, std::ptrdiff_t n) {
#pragma GCC ivdep
      for (std::ptrdiff_t c = row; c < row + n; ++c)
        normal[c] = normal_velocity(calm, trace.below(c), trace.above(c));
    });
  }
}

/// u_e ∂u_c/∂x_e of cells from upwind values traced along e alone, of the owned cells and one layer around
/// them across the other axes.
void Godunov::transverse_terms(const GhostedVector& u, double dt) {
  const double calm = calm_;
  const double scale = 0.5 / grid_.h();
  double* face = face_.first();
  for (int e = 0; e < 3; ++e) {
    const std::ptrdiff_t s = layout_.stride(e);
    const double* normal = face_velocity_[e].first();
    for_each_slab(layout_.owned().grown(1).grown(e, -1, -1), [&](const CellRange& cells) {
      for (int component = 0; component < 3; ++component) {
        const NormalTrace trace = normal_trace(u, component, e, dt);
        for_each_row(layout_, cells.grown(e, 0, 1), [=](std::ptrdiff_t row, std::ptrdiff_t n) {
#pragma GCC ivdep
          for (std::ptrdiff_t c = row; c < row + n; ++c)
            face[c] = upwind(normal[c], calm, trace.below(c), trace.above(c));
        });
        double* term = transverse_[component][e].first();
        for_each_row(layout_, cells, [=](std::ptrdiff_t row, std::ptrdiff_t n) {
#pragma GCC ivdep
          for (std::ptrdiff_t c = row; c < row + n; ++c)
            term[c] = scale * (normal[c] + normal[c + s]) * (face[c + s] - face[c]);
        });
      }
    });
  }
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

void Godunov::advect(const GhostedVector& u, const BlockVector& acceleration, double dt,
                     grid::VectorField& advection) {
  const double calm = calm_;
  const double per_h = 1 / grid_.h();
  double* flux = face_.first();
  for_each_slab(layout_.owned(), [&](const CellRange& cells) {
    for (int component = 0; component < 3; ++component) {
      double* rate = advection[component].values().data();
      for (int axis = 0; axis < 3; ++axis) {
        const std::ptrdiff_t s = layout_.stride(axis);
        const FaceStates states = face_states(u, acceleration, component, axis, dt);
        const double* normal = face_velocity_[axis].first();
        for_each_row(layout_, cells.grown(axis, 0, 1), [=](std::ptrdiff_t row, std::ptrdiff_t n) {
#pragma GCC ivdep
          for (std::ptrdiff_t c = row; c < row + n; ++c)
            flux[c] = normal[c] * upwind(normal[c], calm, states.below(c), states.above(c));
        });
        for_each_owned_row(layout_, cells, [=](std::ptrdiff_t row, std::ptrdiff_t place, std::ptrdiff_t n) {
          const double* f = flux + row;
          double* r = rate + place;
#pragma GCC ivdep
          for (std::ptrdiff_t i = 0; i < n; ++i) r[i] = (axis == 0 ? 0.0 : r[i]) + per_h * (f[i + s] - f[i]);
        });
      }
    }
  });
}

}  // namespace spume::flow
