#include "spume/interface/indicators.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "spume/base/contract.hpp"
#include "spume/grid/spectral_filter.hpp"
#include "spume/interface/profile.hpp"
#include "spume/mesh/phase_frames.hpp"

namespace spume::interface {

namespace {

/// Six-point quadrature on a triangle, exact to degree 4 (Dunavant 1985); weights add up to one.
struct QuadraturePoint {
  std::array<double, 3> barycentric;
  double weight;
};
constexpr double a1 = 0.445948490915965, b1 = 0.108103018168070, w1 = 0.223381589678011;
constexpr double a2 = 0.091576213509771, b2 = 0.816847572980459, w2 = 0.109951743655322;
constexpr std::array<QuadraturePoint, 6> quadrature{{{{a1, a1, b1}, w1},
                                                     {{a1, b1, a1}, w1},
                                                     {{b1, a1, a1}, w1},
                                                     {{a2, a2, b2}, w2},
                                                     {{a2, b2, a2}, w2},
                                                     {{b2, a2, a2}, w2}}};

using Triangle = std::array<Vec3, 3>;

/// The four flat triangles that stand for a curved one.
std::array<Triangle, 4> pieces(const mesh::FilmMesh& films, int t, const EdgeMidpoints& m) {
  const auto [a, b, c] = films.corners(t);
  return {{{a, m[0], m[2]}, {b, m[1], m[0]}, {c, m[2], m[1]}, {m[0], m[1], m[2]}}};
}

/// Weights of a point along one direction on the five cells around it, and three zeros: of the quadratic
/// B-spline at cell centres, and of the difference of the cubic B-spline between the two faces of each cell.
struct LineWeights {
  int first;
  std::array<double, 8> value, difference;
};

LineWeights line_weights(double place) {  // in cells from the lower face of the box
  LineWeights w;
  const int cell = static_cast<int>(std::floor(place));
  const double t = place - cell;  // 0 … 1 inside the cell
  w.first = cell - 2;
  w.value = {0, 0.5 * (1 - t) * (1 - t), 0.75 - (t - 0.5) * (t - 0.5), 0.5 * t * t};
  const double r = 1 - t;
  const std::array<double, 4> face{r * r * r / 6, 2.0 / 3 - t * t + 0.5 * t * t * t,
                                   2.0 / 3 - r * r + 0.5 * r * r * r, t * t * t / 6};
  w.difference = {face[0], face[1] - face[0], face[2] - face[1], face[3] - face[2], -face[3]};
  return w;
}

using Eight = double __attribute__((vector_size(64)));  // one instruction's worth, or a few

/// The divergence of the fluxes through one curved triangle on the cells around it, before it goes to the
/// fields of two colours: the 24 points of a triangle share most of their cells.
class TriangleSpread {
 public:
  explicit TriangleSpread(const grid::Grid& grid)
      : lower_(grid.box().lower),
        per_h_(1 / grid.h()),
        per_h4_(std::pow(per_h_, 4)),
        k_begin_(grid.z_begin()),
        k_end_(grid.z_end()),
        stride_y_(grid.cells().i),
        stride_z_(static_cast<std::ptrdiff_t>(grid.cells().i) * grid.cells().j),
        lattice_(lattice_of(grid.box())) {}

  /// Clears the cells that points within the given bounds reach. False where this rank owns none of them.
  bool open(const Vec3& lowest, const Vec3& highest) {
    for (int d = 0; d < 3; ++d) {
      first_[d] = static_cast<int>(std::floor(per_h_ * (lowest[d] - lower_[d]))) - 2;
      last_[d] = static_cast<int>(std::floor(per_h_ * (highest[d] - lower_[d]))) + 3;
    }
    if (first_.k >= 0 && last_.k <= lattice_.cells.k) {
      first_.k = std::max(first_.k, k_begin_);
      last_.k = std::min(last_.k, k_end_);
      if (first_.k >= last_.k) return false;
    }
    width_ = last_.i - first_.i + 3;  // room for the eight places of the last row
    plane_ = static_cast<std::size_t>(width_) * (last_.j - first_.j);
    value_.assign(plane_ * (last_.k - first_.k) + 8, 0.0);
    return true;
  }

  /// Adds the flux [m²] at x.
  void add(const Vec3& x, const Vec3& flux) {
    const Vec3 place = per_h_ * (x - lower_);
    const LineWeights wx = line_weights(place.x), wy = line_weights(place.y), wz = line_weights(place.z);
    Eight value, difference;
    std::memcpy(&value, wx.value.data(), sizeof value);
    std::memcpy(&difference, wx.difference.data(), sizeof difference);
    const Vec3 f = per_h4_ * flux;  // flux density on faces (1/h³), and its difference over h
    for (int c = std::max(0, first_.k - wz.first); c < std::min(5, last_.k - wz.first); ++c) {
      double* row = value_.data() + (wz.first + c - first_.k) * plane_ + (wy.first - first_.j) * width_ +
                    (wx.first - first_.i);
      const double fx = f.x * wz.value[c], fy = f.y * wz.value[c], fz = f.z * wz.difference[c];
      for (int b = 0; b < 5; ++b, row += width_) {
        const double across = fx * wy.value[b];
        const double along = fy * wy.difference[b] + fz * wy.value[b];
        // Three more places than have weights: a whole vector is quicker than five numbers.
        Eight sum;
        std::memcpy(&sum, row, sizeof sum);
        sum += across * difference + along * value;
        std::memcpy(row, &sum, sizeof sum);
      }
    }
  }

  /// Adds what came together, times `sign`, to a field.
  void give(double sign, grid::Field& field) const {
    const int n = last_.i - first_.i;
    const bool in_one_run = first_.i >= 0 && last_.i <= lattice_.cells.i;
    for (int m = first_.k; m < last_.k; ++m) {
      const int k = lattice_.image(m, 0, 2);
      if (k < k_begin_ || k >= k_end_) continue;
      for (int j = first_.j; j < last_.j; ++j) {
        const double* from = value_.data() + (m - first_.k) * plane_ + (j - first_.j) * width_;
        double* row =
            field.values().data() + (k - k_begin_) * stride_z_ + lattice_.image(j, 0, 1) * stride_y_;
        if (in_one_run)
          for (int i = 0; i < n; ++i) row[first_.i + i] += sign * from[i];
        else
          for (int i = 0; i < n; ++i) row[lattice_.image(first_.i + i, 0, 0)] += sign * from[i];
      }
    }
  }

 private:
  Vec3 lower_;
  double per_h_, per_h4_;
  int k_begin_, k_end_;
  std::ptrdiff_t stride_y_, stride_z_;
  Lattice lattice_;
  Index3 first_{}, last_{};
  int width_ = 0;
  std::size_t plane_ = 0;
  std::vector<double> value_;
};

/// Spreads the part of one triangle between phases of colours a and b (−1 stands for a phase without field).
void spread_triangle(const std::array<Triangle, 4>& pieces, int a, int b, TriangleSpread& spread,
                     std::vector<grid::Field>& divergence) {
  Vec3 lowest = pieces[0][0], highest = lowest;
  for (const Triangle& piece : pieces)
    for (const Vec3& x : piece)
      for (int d = 0; d < 3; ++d) {
        lowest[d] = std::min(lowest[d], x[d]);
        highest[d] = std::max(highest[d], x[d]);
      }
  if (!spread.open(lowest, highest)) return;
  for (const Triangle& piece : pieces) {
    const Vec3 area = 0.5 * cross(piece[1] - piece[0], piece[2] - piece[0]);
    for (const auto& [weight, share] : quadrature)
      spread.add(weight[0] * piece[0] + weight[1] * piece[1] + weight[2] * piece[2], -share * area);
  }
  if (a >= 0) spread.give(1, divergence[a]);
  if (b >= 0) spread.give(-1, divergence[b]);
}

/// Spreads all films; gives the volume of each colour [m³].
std::vector<double> spread_films(const grid::Grid& grid, const mesh::FilmMesh& films,
                                 const std::vector<EdgeMidpoints>& midpoints, const PhaseColours& colours,
                                 std::vector<grid::Field>& divergence) {
  TriangleSpread spread(grid);
  const auto n_phases = static_cast<mesh::Phase>(colours.colour.size());
  const mesh::PhaseFrames frames(films, n_phases);
  std::vector<double> cones(n_phases, 0.0);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const mesh::Phase phase_a = films.triangle[t].phase_a, phase_b = films.triangle[t].phase_b;
    const int a = colours.colour[phase_a], b = colours.colour[phase_b];
    const std::array<Triangle, 4> parts = pieces(films, t, midpoints[t]);
    for (const Triangle& piece : parts) {
      const Vec3 area = 0.5 * cross(piece[1] - piece[0], piece[2] - piece[0]);
      if (a >= 0) cones[phase_a] += frames.cone(phase_a, piece, area);
      if (b >= 0) cones[phase_b] -= frames.cone(phase_b, piece, area);
    }
    spread_triangle(parts, a, b, spread, divergence);
  }
  std::vector<double> volume(colours.n_colours, 0.0);
  for (mesh::Phase p = 0; p < n_phases; ++p)
    if (colours.colour[p] >= 0) volume[colours.colour[p]] += frames.volume(p, cones[p]);
  return volume;
}

double sinc_cubed(double x) {
  const double s = x == 0 ? 1 : std::sin(x) / x;
  return s * s * s;
}

/// What each mode along one axis contributes to the factor of the indicator filter.
struct AxisFactors {
  std::vector<double> laplacian;  ///< of −∇²_h [1/m²]
  std::vector<double> z;          ///< s k²/2
  std::vector<double> other;      ///< e^{−z} over the B-spline's sinc³
};
AxisFactors axis_factors(std::span<const double> theta, double h, double variance) {
  AxisFactors factors;
  for (const double angle : theta) {
    factors.laplacian.push_back((2 - 2 * std::cos(angle)) / (h * h));
    factors.z.push_back(0.5 * variance * angle * angle / (h * h));
    factors.other.push_back(std::exp(-factors.z.back()) / sinc_cubed(0.5 * angle));
  }
  return factors;
}

/// From the divergence of the spread fluxes to smoothed indicators without their mean.
grid::SpectralFilter indicator_filter(const grid::Grid& grid, double variance) {
  const double h = grid.h();
  using Filter = grid::SpectralFilter;
  return {grid, grid::even_symmetry, [h, variance](const Filter::AxisAngles& theta) -> Filter::FactorOfRow {
            return [x = axis_factors(theta[0], h, variance), y = axis_factors(theta[1], h, variance),
                    z = axis_factors(theta[2], h, variance)](int j, int k, std::span<double> factors) {
              const double laplacian = y.laplacian[j] + z.laplacian[k], z_yz = y.z[j] + z.z[k],
                           other = -y.other[j] * z.other[k];
              for (std::size_t i = 0; i < factors.size(); ++i)
                factors[i] =
                    smoothing_polynomial(x.z[i] + z_yz) * other * x.other[i] / (x.laplacian[i] + laplacian);
              if (!(x.laplacian[0] + laplacian > 0)) factors[0] = 0;  // the mean, given by the volume
            };
          }};
}

}  // namespace

PhaseColours colour_phases(const grid::Grid& grid, const mesh::FilmMesh& films, int n_phases) {
  constexpr int reach = 6;
  PhaseColours colours;
  colours.colour.assign(n_phases, -1);
  colours.cells.assign(n_phases, no_cells());
  const Lattice lattice = lattice_of(grid.box());
  const mesh::PhaseFrames frames(films, n_phases);
  for (int p = 1; p < n_phases; ++p) {
    const Vec3 lower = (frames.lower(p) - grid.box().lower) / grid.h(),
               upper = (frames.upper(p) - grid.box().lower) / grid.h();
    if (!(lower.x <= upper.x)) continue;  // no films
    for (int d = 0; d < 3; ++d) {
      colours.cells[p].begin[d] = static_cast<int>(std::floor(lower[d]));
      colours.cells[p].end[d] = static_cast<int>(std::floor(upper[d])) + 1;
    }
  }
  std::vector<std::vector<int>> phases_of_colour;
  for (int p = 1; p < n_phases; ++p) {
    if (colours.cells[p].empty()) continue;
    const bool bounded = frames.bounded(p, 0) && frames.bounded(p, 1) && frames.bounded(p, 2);
    colours.cells[p] = bounded ? lattice.grown(colours.cells[p], reach) : all_cells(grid.cells());
    int c = 0;
    const auto is_free = [&](int colour) {
      for (int q : phases_of_colour[colour])
        if (lattice.overlap(colours.cells[p], colours.cells[q])) return false;
      return true;
    };
    while (c < static_cast<int>(phases_of_colour.size()) && !is_free(c)) ++c;
    if (c == static_cast<int>(phases_of_colour.size())) phases_of_colour.emplace_back();
    phases_of_colour[c].push_back(p);
    colours.colour[p] = c;
  }
  colours.n_colours = static_cast<int>(phases_of_colour.size());
  return colours;
}

std::vector<std::vector<double>> smoothed_indicators(const grid::Grid& grid, const mesh::FilmMesh& films,
                                                     const std::vector<EdgeMidpoints>& midpoints,
                                                     const PhaseColours& colours, double variance) {
  expects(midpoints.size() == films.triangle.size(), "one set of midpoints a triangle");
  std::vector<grid::Field> field(colours.n_colours, grid::Field(grid));
  const std::vector<double> volume = spread_films(grid, films, midpoints, colours, field);
  std::vector<std::vector<double>> indicators(colours.n_colours);
  if (field.empty()) return indicators;
  const grid::SpectralFilter filter = indicator_filter(grid, variance);
  const Vec3 size = grid.box().size();
  for (int c = colours.n_colours - 1; c >= 0; --c) {
    filter.apply(field[c], field[c]);
    indicators[c] = grid::gather(field[c]);
    field.pop_back();  // its memory serves the next
    const double mean = volume[c] / (size.x * size.y * size.z);
    for (double& value : indicators[c]) value += mean;
  }
  return indicators;
}

}  // namespace spume::interface
