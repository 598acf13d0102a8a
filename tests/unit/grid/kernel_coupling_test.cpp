#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "boxes.hpp"
#include "spume/base/error.hpp"
#include "spume/grid/sharpening.hpp"

namespace spume::grid {
namespace {

using parallel::Communicator;

class KernelCouplingOn : public testing::TestWithParam<NamedBox> {};
INSTANTIATE_TEST_SUITE_P(Boxes, KernelCouplingOn, testing::ValuesIn(test_boxes()),
                         [](const auto& test) { return test.param.name; });

/// Points all over the box, up to its faces.
std::vector<Vec3> random_points(const Box& box, int n) {
  Random random(99);
  std::vector<Vec3> points(n);
  for (Vec3& point : points)
    for (int axis = 0; axis < 3; ++axis) point[axis] = random.uniform(box.lower[axis], box.upper[axis]);
  points.push_back(box.lower);
  points.push_back(box.upper);
  return points;
}

std::vector<Vec3> random_vectors(std::size_t n) {
  Random random(123);
  std::vector<Vec3> vectors(n);
  for (Vec3& v : vectors)
    for (int axis = 0; axis < 3; ++axis) v[axis] = 1e-9 * random.uniform(-1, 1);
  return vectors;
}

// Work of spread forces = work on the points. Both sides are sums of about 1e5 products: 1e-12 of the sum of
// their sizes.
TEST_P(KernelCouplingOn, SpreadAndSampleAreAdjoint) {
  const Grid grid(Communicator::world(), GetParam().box);
  const double cell_volume = grid.h() * grid.h() * grid.h();
  VectorField u(grid), density(grid);
  for (int c = 0; c < 3; ++c) fill_random(u[c], 10 * c + 1);
  const std::vector<Vec3> points = random_points(grid.box(), 500), forces = random_vectors(points.size());
  Sharpening sharpening(grid);
  for (const auto placement : {Placement::Centres, Placement::Faces}) {
    const KernelCoupling coupling{placement};
    for (int c = 0; c < 3; ++c) density[c].fill(0);
    coupling.spread(points, forces, density);
    sharpening.apply(density, placement);
    VectorField sharp = u;
    sharpening.apply(sharp, placement);
    std::vector<Vec3> velocities;
    coupling.sample(sharp, points, velocities);
    double on_points = 0, on_grid = 0, size = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      on_points += dot(forces[p], velocities[p]);
      size += norm(forces[p]) * norm(velocities[p]);
    }
    for (int c = 0; c < 3; ++c) {
      Field product = density[c];
      for (std::size_t m = 0; m < product.values().size(); ++m) product.values()[m] *= u[c].values()[m];
      on_grid += cell_volume * sum(product);
    }
    EXPECT_GT(size, 0);
    EXPECT_NEAR(on_points, on_grid, 1e-12 * size);
  }
}

TEST_P(KernelCouplingOn, SamplingAConstantEvenFieldGivesTheConstant) {
  const Grid grid(Communicator::world(), GetParam().box);
  VectorField u(grid);
  for (int c = 0; c < 3; ++c) {
    u[c] = Field(grid, even_symmetry);
    u[c].fill(c + 1.0);
  }
  std::vector<Vec3> velocities;
  Sharpening(grid).apply(u, Placement::Centres);
  KernelCoupling{Placement::Centres}.sample(u, random_points(grid.box(), 200), velocities);
  // S multiplies round-off by up to 1 + 12a + 144b = 15.
  for (const Vec3& v : velocities) EXPECT_NEAR(norm(v - Vec3{1, 2, 3}), 0, 2e-14);
}

TEST_P(KernelCouplingOn, SpreadingIntoEvenFieldsKeepsTheTotalForce) {
  const Grid grid(Communicator::world(), GetParam().box);
  VectorField density(grid);
  for (int c = 0; c < 3; ++c) density[c] = Field(grid, even_symmetry);
  const std::vector<Vec3> points = random_points(grid.box(), 200), forces = random_vectors(points.size());
  KernelCoupling{Placement::Centres}.spread(points, forces, density);
  const double cell_volume = grid.h() * grid.h() * grid.h();
  for (int c = 0; c < 3; ++c) {
    double total = 0, size = 0;
    for (const Vec3& force : forces) {
      total += force[c];
      size += std::abs(force[c]);
    }
    EXPECT_NEAR(cell_volume * sum(density[c]), total, 1e-13 * size);
  }
}

/// The kernel as the documentation writes it, over cells and all their images.
double sample_by_definition(const Field& u, const Vec3& point) {
  const Grid& grid = u.grid();
  const auto ghosts = ghosted<3>(u);
  const double h = grid.h();
  const auto delta = [&](double r) {
    const double s = std::abs(r) / h;
    const double spline = s < 1 ? 2.0 / 3 - s * s + 0.5 * s * s * s : s < 2 ? std::pow(2 - s, 3) / 6 : 0;
    return spline / h;
  };
  const Index3 n = grid.cells();
  double total = 0;
  // Ghosts of the slab count only where they lie beyond the box; the others are another rank's cells.
  const int k_begin = grid.z_begin() == 0 ? -3 : grid.z_begin();
  const int k_end = grid.z_end() == n.k ? n.k + 3 : grid.z_end();
  for (int k = k_begin; k < k_end; ++k)
    for (int j = -3; j < n.j + 3; ++j)
      for (int i = -3; i < n.i + 3; ++i) {
        const Vec3 r = grid.centre(i, j, k) - point;
        total += ghosts(i, j, k) * delta(r.x) * delta(r.y) * delta(r.z);
      }
  return grid.communicator().sum(h * h * h * total);
}

TEST_P(KernelCouplingOn, SampleIsTheConvolutionWithTheContinuedField) {
  const Grid grid(Communicator::world(), GetParam().box);
  VectorField u(grid);
  for (int c = 0; c < 3; ++c) fill_random(u[c], 100 * c + 7);
  const std::vector<Vec3> points = random_points(grid.box(), 8);
  std::vector<Vec3> velocities;
  KernelCoupling{Placement::Centres}.sample(u, points, velocities);
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(velocities[p][c], sample_by_definition(u[c], points[p]), 1e-13);
}

TEST_P(KernelCouplingOn, ResultsAreTheSameToTheLastBitOnAnyNumberOfRanks) {
  const Grid grid(Communicator::world(), GetParam().box);
  const Grid serial(Communicator(MPI_COMM_SELF), GetParam().box);
  const std::vector<Vec3> points = random_points(grid.box(), 100), forces = random_vectors(points.size());
  VectorField u(grid), u_serial(serial);
  KernelCoupling{}.spread(points, forces, u);
  KernelCoupling{}.spread(points, forces, u_serial);
  Sharpening(grid).apply(u);
  Sharpening(serial).apply(u_serial);
  std::vector<Vec3> velocities, velocities_serial;
  KernelCoupling{}.sample(u, points, velocities);
  KernelCoupling{}.sample(u_serial, points, velocities_serial);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(gather(u[c]), gather(u_serial[c]));
  EXPECT_EQ(velocities, velocities_serial);
}

// A film that lies askew in its cells is then moved as one that does not.
TEST(KernelCoupling, SamplesLinearFieldsExactly) {
  const Grid grid(Communicator::world(), test_boxes()[0].box);
  VectorField u(grid);
  const auto linear = [&](const Vec3& x) { return 3 + dot(Vec3{1e3, -2e3, 5e2}, x - grid.box().lower); };
  for (int c = 0; c < 3; ++c) {
    const auto out = owned(u[c]);
    for_each_cell(grid, [&](int i, int j, int k) {
      Vec3 face = grid.centre(i, j, k);
      face[c] -= 0.5 * grid.h();
      out(i, j, k) = linear(face);
    });
  }
  std::vector<Vec3> points, velocities;
  for (const Vec3& x : random_points(grid.box(), 200)) {
    const Vec3 from_lower = x - grid.box().lower, from_upper = grid.box().upper - x;
    double clearance = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
      clearance = std::min({clearance, from_lower[axis], from_upper[axis]});
    if (clearance > 2.5 * grid.h()) points.push_back(x);  // the field jumps where the box closes
  }
  ASSERT_GT(points.size(), 20u);
  KernelCoupling{}.sample(u, points, velocities);
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(velocities[p][c], linear(points[p]), 1e-13);
}

TEST_P(KernelCouplingOn, SharpeningIsAPolynomialOfTheLaplacianOfTheGrid) {
  const Grid grid(Communicator::world(), GetParam().box);
  VectorField u(grid);
  for (int c = 0; c < 3; ++c) fill_random(u[c], 100 * c + 7);
  VectorField sharp = u;
  Sharpening(grid).apply(sharp, Placement::Centres);
  for (int c = 0; c < 3; ++c) {
    const auto bent = [&](const Field& f) {  // −h² Δ_h f
      Field result(grid, f.symmetry());
      const auto ghosts = ghosted<1>(f);
      const auto out = owned(result);
      for_each_cell(grid, [&](int i, int j, int k) {
        out(i, j, k) = 6 * ghosts(i, j, k) - ghosts(i - 1, j, k) - ghosts(i + 1, j, k) - ghosts(i, j - 1, k) -
                       ghosts(i, j + 1, k) - ghosts(i, j, k - 1) - ghosts(i, j, k + 1);
      });
      return result;
    };
    const Field once = bent(u[c]), twice = bent(once);
    for (std::size_t m = 0; m < once.values().size(); ++m)
      EXPECT_NEAR(sharp[c].values()[m],
                  u[c].values()[m] + Sharpening::a * once.values()[m] + Sharpening::b * twice.values()[m],
                  1e-13);
  }
}

// A film that moves with a velocity free of divergence keeps the volumes beside it.
TEST_P(KernelCouplingOn, SharpeningOnFacesMakesNoDivergence) {
  const Grid grid(Communicator::world(), GetParam().box);
  const auto ghost_of = [&](const Field& f, int c, int i, int j, int k, const Ghosted<1>& ghosts) {
    const std::array<int, 3> at{i, j, k};
    const bool beyond = at[c] == grid.cells()[c] && f.grid().box().boundary[c] != Boundary::Periodic;
    return beyond ? 0.0 : ghosts(i, j, k);
  };
  // The curl of a potential on edges of the grid, here of one that is not zero only within the box.
  VectorField u(grid);
  Field potential(grid);
  const Index3 n = grid.cells();
  const auto value = owned(potential);
  Random random(3);
  std::vector<double> numbers(static_cast<std::size_t>(n.i) * n.j * n.k);
  for (double& x : numbers) x = random.uniform(-1, 1);
  for_each_cell(grid, [&](int i, int j, int k) {
    const bool inside = i > 3 && j > 3 && k > 3 && i < n.i - 3 && j < n.j - 3 && k < n.k - 3;
    value(i, j, k) = inside ? numbers[(static_cast<std::size_t>(k) * n.j + j) * n.i + i] : 0;
  });
  const auto psi = ghosted<1>(potential);  // on the edge along z at the lower corner of cell (i, j)
  const auto along_x = owned(u[0]), along_y = owned(u[1]);
  for_each_cell(grid, [&](int i, int j, int k) {
    along_x(i, j, k) = psi(i, j + 1, k) - psi(i, j, k);
    along_y(i, j, k) = psi(i, j, k) - psi(i + 1, j, k);
  });
  Sharpening(grid).apply(u);
  const Ghosted<1> x(u[0]), y(u[1]), z(u[2]);
  double largest = 0;
  for_each_cell(grid, [&](int i, int j, int k) {
    largest = std::max(largest, std::abs(x(i, j, k)));
    const double divergence = ghost_of(u[0], 0, i + 1, j, k, x) - x(i, j, k) +
                              ghost_of(u[1], 1, i, j + 1, k, y) - y(i, j, k) +
                              ghost_of(u[2], 2, i, j, k + 1, z) - z(i, j, k);
    EXPECT_NEAR(divergence, 0, 1e-12);
  });
  EXPECT_GT(grid.communicator().max(largest), 1);
}

using Complex = std::complex<double>;

double square(double x) {
  return x * x;
}

/// Linear theory of a plane film in gas at rest, lengths in cells, ρ = 1: the wave exp(ikx + st) of tension T
/// and viscosity ν obeys s = −T k² G(s), G the velocity that a force of unit rate gives the film,
///   G = (1/2π) ∫ P(k, q) M²(q) |K̂ S|² / (s + ν(κ + χ)) dq,  P = D²(k)/(D²(k) + D²(q)),
/// with M(q) = cos(q/2) (4 − cos q)/3, D(q) = 2 sin(q/2) M(q), κ = 4 sin²(k/2), χ = 4 sin²(q/2), S = 1 +
/// a(κ + χ) + b(κ + χ)²: projection, wide means, kernel, viscosity of the grid. P is that of the differences
/// of wide means, not of the seven-point Laplacian which the approximate projection solves: that one is
/// applied to increments, and the pressure which they add up to takes what is left until nothing is.
Complex film_response(double k, Complex s, double nu, bool sharpened) {
  const double pi = std::numbers::pi;
  const auto spline = [](double q) {
    const double x = q / 2;
    return std::abs(x) < 1e-9 ? 1.0 : std::pow(std::sin(x) / x, 4);
  };
  constexpr int n = 2000, n_images = 3;
  const auto mean = [](double q) { return std::cos(q / 2) * (4 - std::cos(q)) / 3; };
  const auto difference_squared = [&](double q) { return square(2 * std::sin(q / 2) * mean(q)); };
  const double kappa = 4 * square(std::sin(k / 2)), along = difference_squared(k);
  Complex integral = 0;
  for (int m = 0; m < n; ++m) {
    // q = π u⁴ puts most points at small q, where the integrand is a peak of width k.
    const double u = (m + 0.5) / n, q = pi * std::pow(u, 4), dq = 4 * pi * std::pow(u, 3) / n;
    double kernel_squared = 0;  // images of the film's place in its cell, averaged over that place
    for (int image = -n_images; image <= n_images; ++image)
      kernel_squared += square(spline(q + 2 * pi * image) * spline(k));
    const double chi = 4 * square(std::sin(q / 2)), lambda = kappa + chi;
    const double sharp = sharpened ? 1 + Sharpening::a * lambda + Sharpening::b * square(lambda) : 1;
    integral += 2 * dq * square(mean(q) * sharp) * kernel_squared * along / (along + difference_squared(q)) /
                (s + nu * lambda);
  }
  return integral / (2 * pi);
}

/// Newton's method from s.
template <class Function>
Complex root(const Function& f, Complex s) {
  for (int n = 0; n < 40; ++n) {
    const Complex d = 1e-6 * s, step = f(s) * d / (f(s + d) - f(s));
    s -= step;
    if (std::abs(step) < 1e-10 * std::abs(s)) break;
  }
  return s;
}

/// Relative errors of frequency and damping of a wave of `cells` a wavelength λ, at ρ = T = λ = 1 and the
/// given viscosity.
std::array<double, 2> wave_errors(double cells, double viscosity, bool sharpened = true) {
  const double k = 2 * std::numbers::pi / cells, tension = std::pow(cells, 3), nu = viscosity * square(cells);
  const double omega_squared = tension * std::pow(k, 3) / 2;
  const Complex exact =
      root([&](Complex s) { return s * s + omega_squared * (1.0 - k / std::sqrt(k * k + s / nu)); },
           std::sqrt(omega_squared) * Complex(-0.1, 1));
  // Flat triangles of equal edges h have the stiffness k² (1 − k²/16).
  const double stiffness = tension * k * k * (1 - k * k / 16);
  const Complex here =
      root([&](Complex s) { return s + stiffness * film_response(k, s, nu, sharpened); }, exact);
  return {here.imag() / exact.imag() - 1, here.real() / exact.real() - 1};
}

// Waves of 2σρλ/μ² = 3000, whose Stokes layer spans a cell at 16 cells a wavelength. A relative error e of
// the frequency is one of about e of the amplitude over ω0 t = 25.
TEST(KernelCoupling, LinearFilmWavesHaveTheirFrequencyAndDamping) {
  const double viscosity = 1 / std::sqrt(3000.0);
  for (const auto& [cells, of_frequency, of_damping] :
       {std::array{16.0, 0.004, 0.06}, {32.0, 0.002, 0.03}, {64.0, 0.0005, 0.01}}) {
    const auto [frequency, damping] = wave_errors(cells, viscosity);
    EXPECT_LT(std::abs(frequency), of_frequency) << cells;
    EXPECT_LT(std::abs(damping), of_damping) << cells;
    const auto plain = wave_errors(cells, viscosity, false);
    EXPECT_LT(plain[0], -0.004) << cells;
  }
}

// Where the Stokes layer spans five cells and more.
TEST(KernelCoupling, FrequencyOfLinearFilmWavesIsOfSecondOrderInResolvedLayers) {
  const double coarse = wave_errors(32, 0.1)[0], fine = wave_errors(64, 0.1)[0];
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}

TEST(KernelCoupling, FacesLieHalfACellBelowCentres) {
  const Grid grid(Communicator::world(), test_boxes()[0].box);
  VectorField u(grid);
  const double k = 2 * std::numbers::pi / grid.box().size().x;
  const auto wave = [&](double x) { return std::sin(k * (x - grid.box().lower.x)); };
  for (int c = 0; c < 3; ++c) {
    const auto out = owned(u[c]);
    for_each_cell(grid, [&](int i, int j, int l) {
      out(i, j, l) = wave(grid.centre(i, j, l).x - (c == 0 ? 0.5 * grid.h() : 0));
    });
  }
  std::vector<Vec3> velocities;
  const std::vector<Vec3> points = random_points(grid.box(), 20);
  KernelCoupling{}.sample(u, points, velocities);
  // The kernel changes the wave's amplitude by some percent; half a cell off would be an error of 0.2.
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(velocities[p].x, wave(points[p].x), 0.05);
    EXPECT_NEAR(velocities[p].y, wave(points[p].x), 0.05);
  }
}

TEST(KernelCoupling, PointsOutsideAPeriodicBoxActAsTheirImages) {
  const Grid grid(Communicator::world(), test_boxes()[0].box);
  VectorField u(grid);
  for (int c = 0; c < 3; ++c) fill_random(u[c], c);
  const Vec3 point = grid.centre(3, 4, 5) + 0.3 * grid.h() * Vec3{1, 1, 1};
  const Vec3 size = grid.box().size();
  const std::vector<Vec3> points{point, point + size, point - 2.0 * size};
  std::vector<Vec3> velocities;
  KernelCoupling{}.sample(u, points, velocities);
  // The image's coordinates are rounded: some ulp of 1e-3 m against h = 2.5e-5 m.
  EXPECT_NEAR(norm(velocities[1] - velocities[0]), 0, 1e-12);
  EXPECT_NEAR(norm(velocities[2] - velocities[0]), 0, 1e-12);
}

TEST(KernelCoupling, VelocityVanishesOnNoSlipWallsAndItsNormalPartOnSlipWalls) {
  const Grid grid(Communicator::world(), test_boxes()[2].box);  // periodic, slip, wall
  VectorField u(grid);
  for (int c = 0; c < 3; ++c) fill_random(u[c], c);
  const Box& box = grid.box();
  const Vec3 inside = box.lower + 0.4 * box.size();
  const std::vector<Vec3> points{{inside.x, inside.y, box.lower.z}, {inside.x, box.upper.y, inside.z}};
  std::vector<Vec3> velocities;
  KernelCoupling{Placement::Centres}.sample(u, points, velocities);
  // Round-off of the distance to the lower face, 16 cells, in cells.
  EXPECT_NEAR(norm(velocities[0]), 0, 1e-13);
  EXPECT_NEAR(velocities[1].y, 0, 1e-13);
  EXPECT_GT(std::abs(velocities[1].x), 1e-3);
  EXPECT_GT(std::abs(velocities[1].z), 1e-3);
}

TEST(KernelCoupling, LostPointsAreANumericalError) {
  const Grid grid(Communicator::world(), test_boxes()[0].box);
  VectorField u(grid);
  std::vector<Vec3> velocities;
  const std::vector<Vec3> not_a_number{{0, std::numeric_limits<double>::quiet_NaN(), 0}}, far{{1e300, 0, 0}};
  EXPECT_THROW(KernelCoupling{}.sample(u, not_a_number, velocities), NumericalError);
  EXPECT_THROW(KernelCoupling{}.spread(far, far, u), NumericalError);
}

}  // namespace
}  // namespace spume::grid
