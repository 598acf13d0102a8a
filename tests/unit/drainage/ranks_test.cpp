#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "networks.hpp"
#include "spume/base/error.hpp"
#include "spume/drainage/drain.hpp"
#include "spume/drainage/equations.hpp"
#include "spume/drainage/lamella_shares.hpp"

// Run on 1, 2 and 3 ranks.
namespace spume::drainage {
namespace {

using parallel::Communicator;

const state::Materials soap{.gas = {}, .liquid = {1000, 1e-3}, .film = {0.034}, .gravity = {0.5, 2.0, -9.5}};

/// Six films of different η that meet in a junction.
state::FilmNetwork corner() {
  auto network = testing::tetrahedral_corner({2e-4, 4e-4, 7e-4, 1e-3}, 3e-6, 3e-8);
  for (std::size_t d = 0; d < network.half_thickness.size(); ++d)
    network.half_thickness[d] *= 1 + 0.1 * network.topology.film_dof[d].lamella + 0.2 * std::sin(3.0 * d);
  return network;
}

/// What drain() throws; empty if it does not.
std::string failure_of(state::FilmNetwork network, const DrainageParameters& parameters,
                       const Communicator& communicator) {
  try {
    drain(network, soap, parameters, 0, testing::thinnest_node, {}, communicator);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return {};
}

TEST(ShareOut, gives_the_costliest_first_to_the_rank_with_the_least) {
  EXPECT_EQ(share_out(std::vector{2., 7., 4., 5., 3.}, 2), (std::vector{1, 0, 1, 1, 0}));
  EXPECT_EQ(share_out(std::vector{1., 1., 1.}, 3), (std::vector{0, 1, 2}));
  EXPECT_EQ(share_out(std::vector{5.}, 3), std::vector{0});
}

TEST(ShareOut, is_within_a_third_of_the_mean_and_the_largest) {
  std::vector<double> cost;
  for (int n = 0; n < 25; ++n) cost.push_back(1 + 10 * std::abs(std::sin(7.0 * n)));
  const double sum = std::accumulate(cost.begin(), cost.end(), 0.0);
  for (int ranks : {2, 3, 4, 7}) {
    std::vector<double> load(ranks, 0.0);
    const auto rank = share_out(cost, ranks);
    for (std::size_t n = 0; n < cost.size(); ++n) load[rank[n]] += cost[n];
    EXPECT_LE(*std::max_element(load.begin(), load.end()), 4. / 3 * std::max(sum / ranks, 11.0));
    EXPECT_GT(*std::min_element(load.begin(), load.end()), 0);
  }
}

TEST(LamellaShares, give_each_lamella_to_one_rank_and_its_values_to_all) {
  const Communicator world = Communicator::world();
  const auto network = corner();
  LamellaShares shares(network.topology, world);
  std::vector<double> owners(network.topology.n_lamellae(), 0.0);
  for (int l : shares.own()) owners[l] = 1;
  world.sum(owners);
  EXPECT_EQ(owners, std::vector<double>(network.topology.n_lamellae(), 1.0));
  EXPECT_EQ(shares.imbalance(), 1.0);  // six alike to one, two or three ranks

  std::vector<double> values(network.topology.film_dof.size(), -1.0);
  for (std::size_t d = 0; d < values.size(); ++d)
    if (std::ranges::count(shares.own(), network.topology.film_dof[d].lamella) > 0) values[d] = 0.1 * d;
  shares.exchange(values);
  for (std::size_t d = 0; d < values.size(); ++d) EXPECT_EQ(values[d], 0.1 * d);
}

/// One rank alone and all together end with the same bits.
void expect_same_bits(state::FilmNetwork alone, const DrainageParameters& parameters, double threshold) {
  state::FilmNetwork together = alone;
  const auto expected = drain(alone, soap, parameters, threshold, testing::thinnest_node, {});
  const auto outcome =
      drain(together, soap, parameters, threshold, testing::thinnest_node, {}, Communicator::world());
  EXPECT_EQ(together.half_thickness, alone.half_thickness);
  EXPECT_EQ(together.border_area, alone.border_area);
  EXPECT_EQ(outcome.elapsed, expected.elapsed);
  EXPECT_EQ(outcome.ending, expected.ending);
  EXPECT_EQ(outcome.n_steps, expected.n_steps);
  EXPECT_EQ(outcome.n_rejected, expected.n_rejected);
  EXPECT_EQ(outcome.ledger_error, expected.ledger_error);
  EXPECT_GE(outcome.n_steps, 5);
}

TEST(Drain, has_the_same_bits_on_any_number_of_ranks) {
  expect_same_bits(corner(), {.max_time = 5, .tolerance = 0.02, .max_step = 1}, 0);
}

TEST(Drain, has_the_same_bits_up_to_a_rupture) {
  expect_same_bits(corner(), {}, 5e-8);
}

TEST(Drain, has_the_same_bits_without_borders_where_most_ranks_have_nothing_to_do) {
  auto bubble = testing::single_bubble(1e-3, 2, 1e-6);
  for (std::size_t d = 0; d < bubble.half_thickness.size(); ++d)
    bubble.half_thickness[d] *= 1 + 0.2 * std::sin(3.0 * d);
  expect_same_bits(bubble, {.max_time = 5, .tolerance = 1e-4}, 0);
}

TEST(Drain, has_the_same_bits_as_published) {
  auto network = corner();
  std::fill(network.half_thickness.begin(), network.half_thickness.end(), 1e-6);
  expect_same_bits(network, {.scheme = Scheme::Paper, .max_time = 1e-3, .max_step = 1e-4}, 0);
}

TEST(Drain, fails_on_all_ranks_where_the_lamella_of_one_has_no_area) {
  auto network = corner();
  const int last = network.topology.n_lamellae() - 1;
  for (const auto& [vertex, lamella] : network.topology.film_dof)
    if (lamella == last && network.topology.vertex_kind[vertex] == mesh::VertexKind::Film)
      network.mesh.position[vertex] = network.mesh.position[0];  // where borders meet: slivers without area
  for (const Scheme scheme : {Scheme::Positive, Scheme::Paper}) {
    const DrainageParameters parameters{.scheme = scheme, .max_time = 0.01};
    const std::string alone = failure_of(network, parameters, Communicator::self());
    EXPECT_NE(alone, "");
    EXPECT_EQ(failure_of(network, parameters, Communicator::world()), alone);
  }
}

TEST(Drain, as_published_fails_on_all_ranks_where_the_film_of_one_runs_dry) {
  const auto network = testing::tetrahedral_corner({2e-4, 4e-4, 6e-4, 8e-4, 1e-3}, 5e-6, 5e-8);
  const DrainageParameters parameters{.scheme = Scheme::Paper, .max_time = 16};
  const std::string alone = failure_of(network, parameters, Communicator::self());
  EXPECT_NE(alone, "");
  EXPECT_EQ(failure_of(network, parameters, Communicator::world()), alone);
}

TEST(DrainageEquations, tell_all_ranks_of_a_matrix_that_one_cannot_factorise) {
  const auto network = corner();
  DrainageEquations equations(network, soap, Communicator::world());
  Unknowns y = equations.read(network), rate;
  equations.linearise(y, rate);
  EXPECT_TRUE(equations.factorise(1e-3));
  for (std::size_t d = 0; d < y.film.size(); ++d)
    if (network.topology.film_dof[d].lamella == network.topology.n_lamellae() - 1)
      y.film[d] = std::numeric_limits<double>::infinity();
  equations.linearise(y, rate);
  EXPECT_FALSE(equations.factorise(1e-3));
}

}  // namespace
}  // namespace spume::drainage
