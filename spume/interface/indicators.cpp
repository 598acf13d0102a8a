#include "spume/interface/indicators.hpp"

#include <array>
#include <cmath>

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

/// Weights of a point along one direction on the five cells around it: of the quadratic B-spline at cell
/// centres, and of the difference of the cubic B-spline between the two faces of each cell.
struct LineWeights {
  int first;
  std::array<double, 5> value, difference;
};

LineWeights line_weights(double place) {  // in cells from the lower face of the box
  LineWeights w;
  const int cell = static_cast<int>(std::floor(place));
  const double t = place - cell;  // 0 … 1 inside the cell
  w.first = cell - 2;
  w.value = {0, 0.5 * (1 - t) * (1 - t), 0.75 - (t - 0.5) * (t - 0.5), 0.5 * t * t, 0};
  const double r = 1 - t;
  const std::array<double, 4> face{r * r * r / 6, 2.0 / 3 - t * t + 0.5 * t * t * t,
                                   2.0 / 3 - r * r + 0.5 * r * r * r, t * t * t / 6};
  w.difference = {face[0], face[1] - face[0], face[2] - face[1], face[3] - face[2], -face[3]};
  return w;
}

/// Spreads the divergence of fluxes to the owned cells of the fields of their colours.
class DivergenceSpreader {
 public:
  DivergenceSpreader(const grid::Grid& grid, std::vector<grid::Field>& divergence)
      : lower_(grid.box().lower),
        per_h_(1 / grid.h()),
        per_h4_(std::pow(per_h_, 4)),
        k_begin_(grid.z_begin()),
        k_end_(grid.z_end()),
        stride_y_(grid.cells().i),
        stride_z_(static_cast<std::ptrdiff_t>(grid.cells().i) * grid.cells().j),
        lattice_(lattice_of(grid.box())) {
    for (auto& field : divergence) data_.push_back(field.values().data());
  }

  /// Adds the flux [m²] at x to one colour and takes it from another; −1 stands for a phase without field.
  void spread(const Vec3& x, const Vec3& flux, int add_to, int take_from) const {
    const Vec3 place = per_h_ * (x - lower_);
    const LineWeights wx = line_weights(place.x), wy = line_weights(place.y), wz = line_weights(place.z);
    const Vec3 f = per_h4_ * flux;  // flux density on faces (1/h³), and its difference over h
    // The first of five cells; beyond it they may go on at the other end of the grid.
    const int first = lattice_.image(wx.first, 0, 0);
    const bool in_one_run = first + 5 <= lattice_.cells.i;
    for (int c = 0; c < 5; ++c) {
      const int k = lattice_.image(wz.first + c, 0, 2);
      if (k < k_begin_ || k >= k_end_) continue;
      for (int b = 0; b < 5; ++b) {
        const double across = f.x * wy.value[b] * wz.value[c];
        const double along = f.y * wy.difference[b] * wz.value[c] + f.z * wy.value[b] * wz.difference[c];
        const std::ptrdiff_t row =
            (k - k_begin_) * stride_z_ + lattice_.image(wy.first + b, 0, 1) * stride_y_;
        std::array<double, 5> share;
        for (int a = 0; a < 5; ++a) share[a] = across * wx.difference[a] + along * wx.value[a];
        if (add_to >= 0) add(data_[add_to] + row, first, in_one_run, share, 1);
        if (take_from >= 0) add(data_[take_from] + row, first, in_one_run, share, -1);
      }
    }
  }

 private:
  void add(double* row, int first, bool in_one_run, const std::array<double, 5>& share, double sign) const {
    if (in_one_run)
      for (int a = 0; a < 5; ++a) row[first + a] += sign * share[a];
    else
      for (int a = 0; a < 5; ++a) row[lattice_.image(first + a, 0, 0)] += sign * share[a];
  }

  Vec3 lower_;
  double per_h_, per_h4_;
  int k_begin_, k_end_;
  std::ptrdiff_t stride_y_, stride_z_;
  Lattice lattice_;
  std::vector<double*> data_;
};

/// Spreads all films; gives the volume of each colour [m³].
std::vector<double> spread_films(const grid::Grid& grid, const mesh::FilmMesh& films,
                                 const std::vector<EdgeMidpoints>& midpoints, const PhaseColours& colours,
                                 std::vector<grid::Field>& divergence) {
  const DivergenceSpreader spreader(grid, divergence);
  const auto n_phases = static_cast<mesh::Phase>(colours.colour.size());
  const mesh::PhaseFrames frames(films, n_phases);
  std::vector<double> cones(n_phases, 0.0);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const mesh::Phase phase_a = films.triangle[t].phase_a, phase_b = films.triangle[t].phase_b;
    const int a = colours.colour[phase_a], b = colours.colour[phase_b];
    for (const Triangle& piece : pieces(films, t, midpoints[t])) {
      const Vec3 area = 0.5 * cross(piece[1] - piece[0], piece[2] - piece[0]);
      if (a >= 0) cones[phase_a] += frames.cone(phase_a, piece, area);
      if (b >= 0) cones[phase_b] -= frames.cone(phase_b, piece, area);
      for (const auto& [weight, share] : quadrature) {
        const Vec3 x = weight[0] * piece[0] + weight[1] * piece[1] + weight[2] * piece[2];
        spreader.spread(x, -share * area, a, b);
      }
    }
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

/// From the divergence of the spread fluxes to smoothed indicators without their mean.
grid::SpectralFilter indicator_filter(const grid::Grid& grid, double variance) {
  const double h = grid.h();
  return {grid, grid::even_symmetry, [h, variance](const Vec3& theta) {
            double laplacian = 0, spline = 1;
            for (int d = 0; d < 3; ++d) {
              laplacian -= (2 - 2 * std::cos(theta[d])) / (h * h);
              spline *= sinc_cubed(0.5 * theta[d]);
            }
            if (laplacian == 0) return 0.0;
            return smoothing_kernel(0.5 * variance * norm_squared(theta) / (h * h)) / (laplacian * spline);
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
  std::vector<std::vector<double>> indicators;
  if (field.empty()) return indicators;
  const grid::SpectralFilter filter = indicator_filter(grid, variance);
  const Vec3 size = grid.box().size();
  for (int c = 0; c < colours.n_colours; ++c) {
    filter.apply(field[c], field[c]);
    indicators.push_back(grid::gather(field[c]));
    const double mean = volume[c] / (size.x * size.y * size.z);
    for (double& value : indicators.back()) value += mean;
  }
  return indicators;
}

}  // namespace spume::interface
