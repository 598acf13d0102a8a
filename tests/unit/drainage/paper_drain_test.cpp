#include "spume/drainage/paper_drain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "networks.hpp"
#include "spume/base/error.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::drainage {
namespace {

const state::Materials soap = {.gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {0, 0, -9.8}};

DrainageParameters paper(double max_time, double max_step = 10) {
  return {.scheme = Scheme::Paper, .max_time = max_time, .max_step = max_step};
}

/// A junction with films thin enough that the suction does not empty their rims at once.
state::FilmNetwork corner() {
  return testing::tetrahedral_corner({2e-4, 4e-4, 6e-4, 8e-4, 1e-3}, 3e-7, 5e-8);
}

TEST(PaperDrain, keeps_the_liquid_and_takes_one_fixed_step) {
  auto network = corner();
  std::vector<double> steps;
  const auto outcome = drain(network, soap, paper(0.2), 0, testing::thinnest_node,
                             [&](const DrainageProgress& progress, const state::FilmNetwork&) {
                               steps.push_back(progress.step);
                               return true;
                             });
  EXPECT_EQ(outcome.ending, Ending::Drained);
  EXPECT_EQ(outcome.elapsed, 0.2);
  EXPECT_GT(outcome.n_steps, 20);
  EXPECT_EQ(outcome.n_rejected, 0);
  EXPECT_LT(std::abs(outcome.ledger_error), 1e-13);
  for (std::size_t n = 0; n + 1 < steps.size(); ++n) EXPECT_EQ(steps[n], steps.front());
  EXPECT_LE(steps.back(), steps.front());
}

/// η and λ after 0.1 s with this step.
std::vector<double> end_of(double step) {
  auto network = corner();
  const auto outcome = drain(network, soap, paper(0.1, step), 0, testing::thinnest_node, {});
  EXPECT_EQ(outcome.n_steps, std::lround(0.1 / step)) << "the step is shorter than asked for";
  std::vector<double> values = network.half_thickness;
  for (const auto& dof : network.topology.border_dof) values.push_back(network.border_area[dof.vertex]);
  return values;
}

double largest_relative(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] / b[i] - 1));
  return largest;
}

TEST(PaperDrain, is_first_order_in_the_step) {
  const auto converged = end_of(1e-3 / 32);
  const double coarse = largest_relative(end_of(1e-3), converged),
               fine = largest_relative(end_of(5e-4), converged);
  // The reference has an error of its own: log₂((1 − 1/32)/(1/2 − 1/32)) = 1.05.
  EXPECT_NEAR(std::log2(coarse / fine), 1.05, 0.1);
}

TEST(PaperDrain, agrees_with_the_positive_scheme_on_the_borders) {
  auto published = corner(), positive = corner();
  drain(published, soap, paper(0.2), 0, testing::thinnest_node, {});
  drain(positive, soap, {.max_time = 0.2, .tolerance = 1e-3}, 0, testing::thinnest_node, {});
  // Two discretisations in space; λ itself changes by a fifth under gravity.
  double difference = 0, change = 0;
  for (const auto& dof : published.topology.border_dof) {
    difference = std::max(difference,
                          std::abs(published.border_area[dof.vertex] / positive.border_area[dof.vertex] - 1));
    change = std::max(change, std::abs(positive.border_area[dof.vertex] / 5e-8 - 1));
  }
  EXPECT_GT(change, 0.1);
  EXPECT_LT(difference, 0.005 * change);
}

TEST(PaperDrain, says_where_and_when_a_film_runs_dry_and_what_helps) {
  auto network = testing::tetrahedral_corner({2e-4, 4e-4, 6e-4, 8e-4, 1e-3}, 5e-6, 5e-8);
  try {
    drain(network, soap, paper(16), 0, testing::thinnest_node, {});
    FAIL() << "the published scheme stayed positive";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(),
                ::testing::MatchesRegex("the published drainage scheme failed .* s after its start, .*"
                                        "half-thickness -.* in the film between phases . and ., at .*m\\..*"
                                        "drainage.scheme = \"positive\" does"));
  }
}

TEST(PaperDrain, stops_when_told_to_and_ruptures_below_the_threshold) {
  auto network = corner();
  const auto stopped =
      drain(network, soap, paper(1), 0, testing::thinnest_node,
            [](const DrainageProgress& progress, const state::FilmNetwork&) { return progress.n_steps < 3; });
  EXPECT_EQ(stopped.ending, Ending::Stopped);
  EXPECT_EQ(stopped.n_steps, 3);
  const double threshold =
      0.95 * *std::min_element(network.half_thickness.begin(), network.half_thickness.end());
  const auto ruptured = drain(network, soap, paper(1), threshold, testing::thinnest_node, {});
  EXPECT_EQ(ruptured.ending, Ending::Ruptured);
  EXPECT_LT(ruptured.thinnest.half_thickness, threshold);
}

TEST(PaperDrain, drains_closed_borders_and_films_without_any) {
  auto ring = testing::double_bubble(1e-3, {0.4, 0.7, 1}, 24, 3e-7, 5e-8);
  EXPECT_LT(std::abs(drain(ring, soap, paper(0.05), 0, testing::thinnest_node, {}).ledger_error), 1e-13);
  auto bubble = testing::single_bubble(1e-3, 2, 1e-6);
  const auto outcome = drain(bubble, soap, paper(0.1, 0.01), 0, testing::thinnest_node, {});
  EXPECT_EQ(outcome.n_steps, 10);
  EXPECT_LT(std::abs(outcome.ledger_error), 1e-13);
}

/// What the scheme says to a network that it cannot treat.
std::string refusal(state::FilmNetwork network) {
  try {
    drain(network, soap, paper(1), 0, testing::thinnest_node, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PaperDrain, refuses_borders_of_a_single_edge_at_a_junction_with_their_place) {
  EXPECT_THAT(refusal(testing::tetrahedral_corner({1e-3}, 3e-7, 5e-8)),
              ::testing::HasSubstr("of a single edge that ends in the junction at (0, 0, 0) m"));
}

TEST(PaperDrain, refuses_a_border_that_goes_on_through_a_junction) {
  // A fourth phase touches the ring between two bubbles in one vertex.
  const auto ring = testing::double_bubble(1e-3, {0.4, 0.7, 1}, 24, 3e-7, 5e-8);
  mesh::FilmMesh films = ring.mesh;
  const int v = ring.topology.border[0].vertices[3], n = films.n_vertices();
  films.position.push_back(films.position[v] + Vec3{0, 1e-3, 1e-3});
  films.position.push_back(films.position[v] + Vec3{1e-3, 1e-3, 1e-3});
  films.triangle.push_back(mesh::make_triangle(v, n, n + 1, 0, 3));
  EXPECT_THAT(refusal(testing::make_network(films, 3e-7, 5e-8)),
              ::testing::HasSubstr("a Plateau border that goes on through the junction at ("));
}

TEST(PaperDrain, accounts_for_the_liquid_of_the_network_that_it_gives_back) {
  auto network = corner();
  const auto liquid = [&] {
    double sum = 0;
    const auto area = mesh::film_dof_areas(network.mesh, network.topology);
    for (std::size_t d = 0; d < area.size(); ++d) sum += 2 * area[d] * network.half_thickness[d];
    const auto length = mesh::border_dof_lengths(network.mesh, network.topology);
    for (std::size_t d = 0; d < length.size(); ++d)
      sum += length[d] * network.border_area[network.topology.border_dof[d].vertex];
    return sum;
  };
  const double before = liquid();
  const auto outcome = drain(network, soap, paper(0.2), 0, testing::thinnest_node, {});
  EXPECT_NEAR(liquid() / before - 1, outcome.ledger_error, 1e-14);  // round-off of two sums
}

TEST(PaperDrain, cannot_start_where_the_films_or_borders_are_dry) {
  auto film = corner(), border = corner();
  film.half_thickness[3] = -1e-7;
  border.border_area[border.topology.junction[0]] = 0;
  EXPECT_THROW(drain(film, soap, paper(1), 0, testing::thinnest_node, {}), NumericalError);
  EXPECT_THROW(drain(border, soap, paper(1), 0, testing::thinnest_node, {}), NumericalError);
}

}  // namespace
}  // namespace spume::drainage
