#include "spume/grid/kernel_coupling.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "boxes.hpp"
#include "spume/base/error.hpp"

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
  for (const auto placement : {Placement::Centres, Placement::Faces})
    for (const double half_width : {1.0, 1.5, 2.0, 2.3}) {
      const KernelCoupling coupling{half_width, 0.3, placement};
      for (int c = 0; c < 3; ++c) density[c].fill(0);
      coupling.spread(points, forces, density);
      std::vector<Vec3> velocities;
      coupling.sample(u, points, velocities);
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
  for (const double half_width : {1.0, 1.5, 2.0}) {
    KernelCoupling{half_width, 0.3, Placement::Centres}.sample(u, random_points(grid.box(), 200), velocities);
    for (const Vec3& v : velocities) EXPECT_NEAR(norm(v - Vec3{1, 2, 3}), 0, 1e-14);
  }
}

TEST_P(KernelCouplingOn, SpreadingIntoEvenFieldsKeepsTheTotalForce) {
  const Grid grid(Communicator::world(), GetParam().box);
  VectorField density(grid);
  for (int c = 0; c < 3; ++c) density[c] = Field(grid, even_symmetry);
  const std::vector<Vec3> points = random_points(grid.box(), 200), forces = random_vectors(points.size());
  KernelCoupling{.placement = Placement::Centres}.spread(points, forces, density);
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

/// The kernel as the documentation writes it: δ(r) = Π (1 + cos(π r_d/ζ))/(2ζ) over cells and all their
/// images.
double sample_by_definition(const Field& u, const Vec3& point, double zeta) {
  const Grid& grid = u.grid();
  const auto ghosts = ghosted<3>(u);
  const double h = grid.h();
  const auto delta = [&](double r) {
    return std::abs(r) < zeta ? (1 + std::cos(std::numbers::pi * r / zeta)) / (2 * zeta) : 0;
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
  for (const double half_width : {1.5, 2.3}) {
    KernelCoupling{half_width, 0, Placement::Centres}.sample(u, points, velocities);
    for (std::size_t p = 0; p < points.size(); ++p)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(velocities[p][c], sample_by_definition(u[c], points[p], half_width * grid.h()), 1e-13);
  }
}

TEST_P(KernelCouplingOn, ResultsAreTheSameToTheLastBitOnAnyNumberOfRanks) {
  const Grid grid(Communicator::world(), GetParam().box);
  const Grid serial(Communicator(MPI_COMM_SELF), GetParam().box);
  const std::vector<Vec3> points = random_points(grid.box(), 100), forces = random_vectors(points.size());
  VectorField u(grid), u_serial(serial);
  KernelCoupling{}.spread(points, forces, u);
  KernelCoupling{}.spread(points, forces, u_serial);
  std::vector<Vec3> velocities, velocities_serial;
  KernelCoupling{}.sample(u, points, velocities);
  KernelCoupling{}.sample(u_serial, points, velocities_serial);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(gather(u[c]), gather(u_serial[c]));
  EXPECT_EQ(velocities, velocities_serial);
}

// The sharpened kernel samples u as the plain one samples u − a h² Δ_h u.
TEST_P(KernelCouplingOn, SharpeningIsTheLaplacianOfTheGrid) {
  const Grid grid(Communicator::world(), GetParam().box);
  VectorField u(grid), sharp(grid);
  constexpr double a = 0.3;
  for (int c = 0; c < 3; ++c) {
    fill_random(u[c], 100 * c + 7);
    const auto ghosts = ghosted<1>(u[c]);
    const auto out = owned(sharp[c]);
    for (int k = grid.z_begin(); k < grid.z_end(); ++k)
      for (int j = 0; j < grid.cells().j; ++j)
        for (int i = 0; i < grid.cells().i; ++i)
          out(i, j, k) = (1 + 6 * a) * ghosts(i, j, k) -
                         a * (ghosts(i - 1, j, k) + ghosts(i + 1, j, k) + ghosts(i, j - 1, k) +
                              ghosts(i, j + 1, k) + ghosts(i, j, k - 1) + ghosts(i, j, k + 1));
  }
  const std::vector<Vec3> points = random_points(grid.box(), 50);
  std::vector<Vec3> of_sharp, sharpened;
  KernelCoupling{1.5, 0, Placement::Centres}.sample(sharp, points, of_sharp);
  KernelCoupling{1.5, a, Placement::Centres}.sample(u, points, sharpened);
  for (std::size_t p = 0; p < points.size(); ++p) EXPECT_NEAR(norm(of_sharp[p] - sharpened[p]), 0, 1e-13);
}

using Complex = std::complex<double>;

double square(double x) {
  return x * x;
}

/// Linear theory of a plane film in gas at rest, lengths in cells, ρ = 1: the wave exp(ikx + st) of tension T
/// and viscosity ν obeys s = −T k² G(s), G the velocity that a force of unit rate gives the film,
///   G = (1/2π) ∫ P(k, q) cos²(q/2) |K̂(k, q)|² / (s + ν(κ + χ)) dq,  P = κ/(κ + χ),
/// with κ = 4 sin²(k/2), χ = 4 sin²(q/2): projection, mean of two cells, kernel, viscosity of the grid.
Complex film_response(double k, Complex s, double nu, const KernelCoupling& coupling) {
  const double pi = std::numbers::pi, zeta = coupling.half_width_cells;
  const auto cosine = [&](double q) {
    const double x = q * zeta, t = x / pi;
    if (std::abs(x) < 1e-9) return 1.0;
    return std::abs(std::abs(t) - 1) < 1e-7 ? 0.5 : std::sin(x) / (x * (1 - t * t));
  };
  constexpr int n = 2000, n_images = 6;
  const double kappa = 4 * square(std::sin(k / 2));
  Complex integral = 0;
  for (int m = 0; m < n; ++m) {
    // q = π u⁴ puts most points at small q, where the integrand is a peak of width k.
    const double u = (m + 0.5) / n, q = pi * std::pow(u, 4), dq = 4 * pi * std::pow(u, 3) / n;
    double kernel_squared = 0;  // images of the film's place in its cell, averaged over that place
    for (int image = -n_images; image <= n_images; ++image)
      kernel_squared += square(cosine(q + 2 * pi * image));
    const double chi = 4 * square(std::sin(q / 2));
    const double sharp = 1 + coupling.sharpening * (kappa + chi);
    integral += 2 * dq * square(std::cos(q / 2) * sharp * cosine(k)) * kernel_squared * kappa /
                (kappa + chi) / (s + nu * (kappa + chi));
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

/// Relative errors of frequency and damping of a wave with the inertia of mode 2 of a bubble of R cells, at
/// ρ = R = 2σ = 1 and the given viscosity.
std::array<double, 2> wave_errors(double radius, double viscosity, const KernelCoupling& coupling) {
  const double k = std::cbrt(9.6) / radius, tension = std::pow(radius, 3), nu = viscosity * square(radius);
  const double omega_squared = tension * std::pow(k, 3) / 2;
  const Complex exact =
      root([&](Complex s) { return s * s + omega_squared * (1.0 - k / std::sqrt(k * k + s / nu)); },
           std::sqrt(omega_squared) * Complex(-0.1, 1));
  const Complex here =
      root([&](Complex s) { return s + tension * k * k * film_response(k, s, nu, coupling); }, exact);
  return {here.imag() / exact.imag() - 1, here.real() / exact.real() - 1};
}

TEST(KernelCoupling, LinearFilmWavesHaveTheirFrequencyAndDamping) {
  const auto [frequency, damping] = wave_errors(16, 0.05, {});
  EXPECT_LT(std::abs(frequency), 0.004);
  EXPECT_LT(std::abs(damping), 0.004);
  const auto plain = wave_errors(16, 0.05, {1.5, 0, Placement::Faces});
  EXPECT_LT(plain[0], -0.009);
  EXPECT_LT(plain[1], -0.04);
  // Of second order where the Stokes layer is resolved.
  EXPECT_NEAR(std::log2(frequency / wave_errors(32, 0.05, {})[0]), 2, 0.3);
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
  KernelCoupling{.placement = Placement::Centres}.sample(u, points, velocities);
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
