#include "spume/fem/network_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace spume::fem {
namespace {

using Link = std::array<int, 2>;

struct Network {
  int n_unknowns = 0;
  std::vector<Link> link;

  int add_unknown() { return n_unknowns++; }
  /// A chain with so many unknowns inside from one unknown to another, its links pointing either way.
  void add_chain(int from, int to, int n_inside) {
    for (int n = 0; n < n_inside; ++n) {
      const int next = add_unknown();
      link.push_back(n % 3 == 1 ? Link{next, from} : Link{from, next});
      from = next;
    }
    link.push_back({from, to});
  }
};

struct Values {
  std::vector<double> diagonal;
  std::vector<std::array<double, 2>> coupling;
};

/// M − sJ of fluxes along the links that grow with the unknown they leave and fall with the one they enter:
/// columns sum to M, which is 1 to 2.
Values flux_matrix(const Network& network, double s, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(0.1, 1);
  Values values;
  for (int u = 0; u < network.n_unknowns; ++u) values.diagonal.push_back(1 + entry(random));
  for (const auto& [from, to] : network.link) {
    const double by_from = s * entry(random), by_to = -s * entry(random);
    values.diagonal[from] += by_from;
    values.diagonal[to] -= by_to;
    values.coupling.push_back({by_to, -by_from});
  }
  return values;
}

Eigen::MatrixXd dense(const Network& network, const Values& values) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(network.n_unknowns, network.n_unknowns);
  for (int u = 0; u < network.n_unknowns; ++u) matrix(u, u) = values.diagonal[u];
  for (std::size_t l = 0; l < network.link.size(); ++l) {
    const auto [from, to] = network.link[l];
    matrix(from, to) += values.coupling[l][0];
    matrix(to, from) += values.coupling[l][1];
  }
  return matrix;
}

/// Largest difference from the dense solution, over its largest entry.
double error_of_solve(NetworkLu& lu, const Network& network, const Values& values) {
  Eigen::VectorXd right(network.n_unknowns);
  for (int u = 0; u < network.n_unknowns; ++u) right(u) = std::sin(3.0 * u + 1);
  const Eigen::VectorXd exact = dense(network, values).fullPivLu().solve(right);
  std::vector<double> x(right.begin(), right.end());
  lu.solve(x);
  return (Eigen::Map<const Eigen::VectorXd>(x.data(), network.n_unknowns) - exact).lpNorm<Eigen::Infinity>() /
         exact.lpNorm<Eigen::Infinity>();
}

/// Round-off: columns sum to 1 at least and are of size s, so that the condition is about s.
void expect_solves(const Network& network) {
  NetworkLu lu(network.n_unknowns, network.link);
  unsigned seed = 1;
  for (double s : {0.3, 30.0, 3000.0, 1e7}) {
    const Values values = flux_matrix(network, s, ++seed);
    ASSERT_TRUE(lu.factorise(values.diagonal, values.coupling));
    EXPECT_LT(error_of_solve(lu, network, values), 1e-15 * (10 + s));
  }
}

/// Borders between junctions, two of them between the same two and one without any inside; one from a
/// junction to itself; one with a free end; a ring; a border with two free ends; an unknown by itself.
Network all_kinds() {
  Network network;
  std::vector<int> junction;
  for (int j = 0; j < 4; ++j) {
    junction.push_back(network.add_unknown());
    network.add_unknown();  // by itself
  }
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) network.add_chain(junction[i], junction[j], i + 2 * j);
  network.add_chain(junction[2], junction[1], 3);
  network.link.push_back({junction[3], junction[0]});
  network.add_chain(junction[3], junction[3], 4);
  network.add_chain(junction[0], network.add_unknown(), 2);
  const int in_ring = network.add_unknown(), end = network.add_unknown();
  network.add_chain(in_ring, in_ring, 5);
  network.add_chain(end, network.add_unknown(), 3);
  return network;
}

TEST(NetworkLu, solves_on_a_network_of_all_kinds_of_chains_as_a_dense_solver_does) {
  const Network network = all_kinds();
  EXPECT_EQ(NetworkLu(network.n_unknowns, network.link).n_junctions(),
            4 + 1 + 1 + 4);  // and one of the ring, of the border with free ends, of each by itself
  expect_solves(network);
}

TEST(NetworkLu, solves_on_chains_and_rings_by_themselves) {
  for (int n_inside : {0, 1, 2, 7}) {
    Network row, ring;
    const int start = row.add_unknown();
    row.add_chain(start, row.add_unknown(), n_inside);
    expect_solves(row);
    ring.add_unknown();
    ring.add_chain(0, 0, n_inside);  // of one unknown: a link to itself
    expect_solves(ring);
  }
  expect_solves({1, {}});
}

TEST(NetworkLu, solves_where_two_unknowns_are_linked_two_and_three_times) {
  expect_solves({2, {{0, 1}, {1, 0}}});
  expect_solves({2, {{0, 1}, {1, 0}, {0, 1}}});
  expect_solves({4, {{0, 1}, {1, 2}, {2, 1}, {2, 3}}});
}

TEST(NetworkLu, solves_on_a_lattice_with_many_junctions) {
  const int m = 4;
  Network network;
  network.n_unknowns = m * m * m;
  for (int i = 0; i < m * m * m; ++i) {
    if (i % m + 1 < m) network.add_chain(i, i + 1, 2);
    if (i / m % m + 1 < m) network.add_chain(i + m, i, 1);
    if (i / (m * m) + 1 < m) network.add_chain(i, i + m * m, 3);
  }
  expect_solves(network);
}

TEST(NetworkLu, wants_as_many_values_as_there_are_unknowns_and_links) {
  const Network network = all_kinds();
  NetworkLu lu(network.n_unknowns, network.link);
  Values values = flux_matrix(network, 10, 3);
  values.coupling.pop_back();
  EXPECT_THROW(lu.factorise(values.diagonal, values.coupling), std::logic_error);
  values = flux_matrix(network, 10, 3);
  values.diagonal.pop_back();
  EXPECT_THROW(lu.factorise(values.diagonal, values.coupling), std::logic_error);
}

TEST(NetworkLu, keeps_what_the_columns_sum_to_over_many_unknowns) {
  // Σ_i (M k)_i = Σ_i b_i, M the column sums: to round-off of the terms, which are s times as large.
  Network network;
  for (int j = 0; j < 2; ++j) network.add_unknown();
  for (int n = 0; n < 4; ++n) network.add_chain(0, 1, 2500);
  const double s = 100;
  const Values values = flux_matrix(network, s, 5);
  NetworkLu lu(network.n_unknowns, network.link);
  ASSERT_TRUE(lu.factorise(values.diagonal, values.coupling));
  std::vector<double> mass = values.diagonal, x;
  for (std::size_t l = 0; l < network.link.size(); ++l) {
    mass[network.link[l][1]] += values.coupling[l][0];
    mass[network.link[l][0]] += values.coupling[l][1];
  }
  double given = 0, found = 0;
  for (int u = 0; u < network.n_unknowns; ++u) {
    x.push_back(1 + 0.5 * std::sin(u));
    given += x.back();
  }
  lu.solve(x);
  for (int u = 0; u < network.n_unknowns; ++u) found += mass[u] * x[u];
  EXPECT_NEAR(found, given, 1e-15 * s * given);
}

TEST(NetworkLu, refuses_what_is_singular_not_finite_or_needs_pivots_and_recovers) {
  const Network network = all_kinds();
  NetworkLu lu(network.n_unknowns, network.link);
  const Values good = flux_matrix(network, 10, 3);
  const auto refuses = [&](const auto& spoil) {
    Values bad = good;
    spoil(bad);
    return !lu.factorise(bad.diagonal, bad.coupling);
  };
  EXPECT_TRUE(refuses([](Values& v) { v.diagonal.assign(v.diagonal.size(), 0.0); }));
  EXPECT_TRUE(refuses([](Values& v) { v.diagonal[8] = 1e-9; }));  // the first of a chain
  EXPECT_TRUE(refuses([](Values& v) { v.diagonal[0] = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refuses([](Values& v) { v.diagonal[8] = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refuses([](Values& v) { v.coupling[0][1] = std::numeric_limits<double>::quiet_NaN(); }));
  ASSERT_TRUE(lu.factorise(good.diagonal, good.coupling));
  EXPECT_LT(error_of_solve(lu, network, good), 1e-14);
}

}  // namespace
}  // namespace spume::fem
