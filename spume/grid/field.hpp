#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "spume/grid/grid.hpp"

namespace spume::grid {

/// How a field continues across a wall, by mirror images: even (zero normal derivative at the face) or odd
/// (zero at the face). Of no effect in periodic directions.
enum class Parity { Even, Odd };
using Symmetry = std::array<Parity, 3>;  ///< for walls across x, y, z

inline constexpr Symmetry even_symmetry{Parity::Even, Parity::Even, Parity::Even};

/// The symmetry of velocity component `component`: odd at no-slip walls, and at slip walls odd for the normal
/// component and even for the others.
Symmetry velocity_symmetry(const Box& box, int component);

/// A cell-centred scalar field. Each rank holds its own slab, contiguous with i fastest: the value of cell
/// (i, j, k) is at ((k − z_begin) n_y + j) n_x + i.
class Field {
 public:
  explicit Field(const Grid& grid, Symmetry symmetry = even_symmetry)
      : grid_(&grid), symmetry_(symmetry), values_(grid.owned_size(), 0.0) {}

  const Grid& grid() const { return *grid_; }
  const Symmetry& symmetry() const { return symmetry_; }
  std::span<double> values() { return values_; }
  std::span<const double> values() const { return values_; }
  void fill(double value) { values_.assign(values_.size(), value); }

 private:
  const Grid* grid_;
  Symmetry symmetry_;
  std::vector<double> values_;
};

/// Three components at cell centres (collocated).
struct VectorField {
  /// With the symmetry of a velocity.
  explicit VectorField(const Grid& grid);
  Field& operator[](int component) { return components[component]; }
  const Field& operator[](int component) const { return components[component]; }

  std::array<Field, 3> components;
};

/// Writable view of the owned cells of a field, addressed by global indices.
class OwnedView {
 public:
  explicit OwnedView(Field& f)
      : data_(f.values().data()), nx_(f.grid().cells().i), ny_(f.grid().cells().j), k0_(f.grid().z_begin()) {}
  double& operator()(int i, int j, int k) const {
    return data_[(static_cast<std::size_t>(k - k0_) * ny_ + j) * nx_ + i];
  }

 private:
  double* data_;
  int nx_, ny_, k0_;
};
inline OwnedView owned(Field& f) {
  return OwnedView(f);
}

/// Fills `buffer` with the owned cells of `f` and `width` layers of ghosts on every side: neighbours' cells,
/// periodic images, or mirror images at walls, edges and corners included. Collective. 1 ≤ width ≤ 4. Shape:
/// (nx+2w)(ny+2w)(nz_owned+2w), i fastest.
void exchange_ghosts(const Field& f, int width, std::vector<double>& buffer);

/// Read-only copy of a field with W layers of ghosts, addressed by global indices from −W to n+W−1 (along z
/// from z_begin−W to z_end+W−1). A function that needs a stencil of width W takes a Ghosted<W>, so that
/// forgetting the exchange cannot be written. Collective construction and update().
template <int W>
class Ghosted {
 public:
  explicit Ghosted(const Field& f) { update(f); }
  void update(const Field& f) {
    exchange_ghosts(f, W, buffer_);
    stride_y_ = f.grid().cells().i + 2 * W;
    stride_z_ = static_cast<std::ptrdiff_t>(stride_y_) * (f.grid().cells().j + 2 * W);
    origin_ = buffer_.data() + (W - f.grid().z_begin()) * stride_z_ + W * stride_y_ + W;
  }
  double operator()(int i, int j, int k) const { return origin_[k * stride_z_ + j * stride_y_ + i]; }
  /// For hot loops: pointer to the value of cell (i, j, k), and the distances between neighbours.
  const double* at(int i, int j, int k) const { return origin_ + k * stride_z_ + j * stride_y_ + i; }
  std::ptrdiff_t stride_y() const { return stride_y_; }
  std::ptrdiff_t stride_z() const { return stride_z_; }

 private:
  std::vector<double> buffer_;
  const double* origin_ = nullptr;
  std::ptrdiff_t stride_y_ = 0, stride_z_ = 0;
};
template <int W>
Ghosted<W> ghosted(const Field& f) {
  return Ghosted<W>(f);
}

/// All cells of a field on every rank, i fastest, then j, k. Collective.
std::vector<double> gather(const Field& f);
/// Takes the owned part out of a whole-box array in the layout of gather(). No communication.
void scatter(std::span<const double> whole, Field& f);

/// Sum over all cells, bitwise the same on every rank and on any number of ranks. Collective.
double sum(const Field& f);
/// Σ of squares over all cells, likewise. Collective.
double sum_of_squares(const Field& f);
/// Largest |value|; infinite where a value is not a number, so that a lost computation cannot pass for a
/// small one. Collective.
double max_abs(const Field& f);

}  // namespace spume::grid
