#include "spume/drainage/step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "networks.hpp"

namespace spume::drainage {
namespace {

const state::Materials soap = {.gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {0, 0, -9.8}};

Unknowns run(DrainageEquations& equations, Unknowns y, Method method, double time, int n_steps) {
  Stepper stepper(equations);
  for (int n = 0; n < n_steps; ++n) {
    stepper.start(y);
    const Trial& trial = stepper.attempt(method, time / n_steps);
    EXPECT_TRUE(trial.positive);
    y = trial.y;
  }
  return y;
}

double largest_difference(const Unknowns& a, const Unknowns& b) {
  double largest = 0;
  for (std::size_t d = 0; d < a.film.size(); ++d)
    largest = std::max(largest, std::abs(a.film[d] / b.film[d] - 1));
  for (std::size_t u = 0; u < a.border.size(); ++u)
    largest = std::max(largest, std::abs(a.border[u] / b.border[u] - 1));
  return largest;
}

/// Order in time from halving `steps` steps, against a run with many more.
double order_in_time(DrainageEquations& equations, const Unknowns& y, Method method, double time, int steps) {
  const Unknowns exact = run(equations, y, Method::Rosenbrock, time, 32 * steps);
  const double coarse = largest_difference(run(equations, y, method, time, steps), exact);
  const double fine = largest_difference(run(equations, y, method, time, 2 * steps), exact);
  return std::log2(coarse / fine);
}

TEST(Stepper, is_second_order_in_time_on_a_flat_film_and_first_with_euler) {
  const double side = 1e-3;
  auto network = testing::square_film(side, 8, 5e-6);
  for (int v = 0; v < network.mesh.n_vertices(); ++v) {
    const Vec3& x = network.mesh.position[v];
    network.half_thickness[v] *=
        1 + 0.3 * std::cos(std::numbers::pi * x.x / side) * std::cos(std::numbers::pi * x.y / side);
  }
  DrainageEquations equations(network, soap);
  const Unknowns y = equations.read(network);
  const double rate =
      0.034 * std::pow(5e-6, 3) / 3e-3 * std::pow(2 * std::pow(std::numbers::pi / side, 2), 2);
  EXPECT_NEAR(order_in_time(equations, y, Method::Rosenbrock, 1 / rate, 16), 2, 0.15);
  EXPECT_NEAR(order_in_time(equations, y, Method::Euler, 1 / rate, 16), 1, 0.15);
}

TEST(Stepper, is_second_order_in_time_with_borders_though_their_part_of_the_jacobian_is_dropped) {
  const auto network = testing::double_bubble(1e-3, {0.4, 0.7, 0.9, 1}, 12, 5e-6, 2e-8);
  DrainageEquations equations(network, soap);
  const Unknowns smooth = run(equations, equations.read(network), Method::Rosenbrock, 0.02, 40);
  EXPECT_NEAR(order_in_time(equations, smooth, Method::Rosenbrock, 0.02, 16), 2, 0.2);
}

TEST(Stepper, keeps_the_liquid_in_every_single_step_of_either_method) {
  const auto network = testing::tetrahedral_corner({2e-4, 5e-4, 1e-3}, 5e-6, 2e-8);
  DrainageEquations equations(network, soap);
  const Unknowns y = equations.read(network);
  const double liquid = equations.liquid(y);
  for (Method method : {Method::Rosenbrock, Method::Euler}) {
    const Unknowns after = run(equations, y, method, 1e-3, 1);
    EXPECT_GT(largest_difference(after, y), 1e-3);
    EXPECT_NEAR(equations.liquid(after), liquid, 1e-15 * liquid);
  }
}

TEST(Stepper, keeps_the_liquid_where_a_triangle_is_tiny) {
  // Triangles of the innermost ring are 1e-10 of the others, so J spans many orders and factors lose digits.
  const auto network = testing::double_bubble(1e-3, {1e-5, 0.5, 0.8, 1}, 12, 5e-6, 2e-8);
  DrainageEquations equations(network, soap);
  const Unknowns y = equations.read(network);
  const Unknowns after = run(equations, y, Method::Rosenbrock, 1e-2, 50);
  EXPECT_NEAR(equations.liquid(after), equations.liquid(y), 1e-14 * equations.liquid(y));
}

TEST(Stepper, estimates_an_error_that_shrinks_with_the_square_of_the_step) {
  const auto network = testing::double_bubble(1e-3, {0.4, 0.7, 0.9, 1}, 12, 5e-6, 2e-8);
  DrainageEquations equations(network, soap);
  for (Method method : {Method::Rosenbrock, Method::Euler}) {
    Stepper stepper(equations);
    stepper.start(run(equations, equations.read(network), Method::Rosenbrock, 0.02, 40));
    const double coarse = stepper.attempt(method, 4e-4).error;
    const double fine = stepper.attempt(method, 2e-4).error;
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.25);
  }
}

TEST(Stepper, reports_a_step_that_would_leave_nothing) {
  auto network = testing::square_film(1e-3, 8, 5e-6);
  network.half_thickness[40] = 1e-9;
  network.half_thickness[41] = 5e-5;
  DrainageEquations equations(network, soap);
  Stepper stepper(equations);
  stepper.start(equations.read(network));
  bool refused = false;
  for (double dt = 1e-6; dt < 1e3 && !refused; dt *= 4) {
    const Trial& trial = stepper.attempt(Method::Rosenbrock, dt);
    refused = !trial.positive;
    if (refused) {
      EXPECT_GE(trial.worst.film_dof, 0);
    }
  }
  EXPECT_TRUE(refused);
}

}  // namespace
}  // namespace spume::drainage
