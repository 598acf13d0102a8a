#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "spume/base/error.hpp"
#include "spume/transport/transfer.hpp"
#include "tests/support/film_shapes.hpp"
#include "tests/unit/transport/film_patterns.hpp"

namespace spume {
namespace {

using patterns::Foam;

constexpr double radius = 1e-3;   // [m]
constexpr double eta0 = 1e-6;     // [m]
constexpr double lambda0 = 1e-9;  // [m²]
constexpr int n_edges = 10;
constexpr double h = 0.9 * radius / n_edges;

double uniform_eta(const Vec3&) {
  return eta0;
}
double uniform_lambda(const Vec3&) {
  return lambda0;
}

/// A double bubble with a disc of the septum given to two phases of its own: a film that another mesh does
/// not have.
Foam with_foreign_disc(const Vec3& centre, double disc_radius) {
  mesh::FilmMesh films = shapes::double_bubble(radius, n_edges);
  for (auto& t : films.triangle) {
    const bool inside = std::all_of(t.vertex.begin(), t.vertex.end(),
                                    [&](int v) { return norm(films.position[v] - centre) < disc_radius; });
    if (t.phase_a == 1 && t.phase_b == 2 && inside) t.phase_a = 3, t.phase_b = 4;
  }
  return Foam(std::move(films));
}

Foam renamed(mesh::FilmMesh films, mesh::Phase from, mesh::Phase to) {
  for (auto& t : films.triangle)
    t = mesh::make_triangle(t.vertex[0], t.vertex[1], t.vertex[2], t.phase_a == from ? to : t.phase_a,
                            t.phase_b == from ? to : t.phase_b);
  return Foam(std::move(films));
}

double ledger_error(const state::FilmLiquid& before, const state::FilmLiquid& after) {
  return std::abs(after.total() / before.total() - 1);
}

TEST(BornLamella, GetsTheMeanThicknessOfItsNeighboursFromThem) {
  const Foam from(shapes::double_bubble(radius, n_edges));
  const Foam to = with_foreign_disc({}, 1.6 * h);
  const int disc = patterns::lamella_between(to, 3, 4);
  ASSERT_GE(disc, 0);
  const state::FilmLiquid liquid = patterns::liquid_of(from, uniform_eta, uniform_lambda);
  transport::TransferReport report;
  const state::FilmLiquid after =
      transport::transfer(parallel::Communicator::self(), from.films, from.topology, liquid, to.films,
                          to.topology, h, {}, report);
  EXPECT_LE(ledger_error(liquid, after), 1e-14);
  EXPECT_EQ(report.n_born_lamellae, 1);
  EXPECT_GT(report.to_born, 0);
  EXPECT_TRUE(after.lamella_is_young[disc]);
  const std::vector<double> eta = patterns::half_thickness(to, after);
  for (std::size_t d = 0; d < eta.size(); ++d)
    if (to.topology.film_dof[d].lamella == disc) {
      // The septum kept its liquid on less area before it lent: a little above η0.
      EXPECT_GT(eta[d], 0.98 * eta0);
      EXPECT_LT(eta[d], 1.1 * eta0);
    } else {
      EXPECT_GT(eta[d], 0.5 * eta0);
    }
}

TEST(GoneLamella, GivesItsLiquidToBordersNearby) {
  const double ring = 0.5 * std::sqrt(3.0) * radius;
  const Vec3 centre{0, ring - 1.3 * h, 0};
  const Foam from = with_foreign_disc(centre, 1.1 * h);  // 3 h around it reaches the ring
  const Foam to(shapes::double_bubble(radius, n_edges));
  state::FilmLiquid liquid = patterns::liquid_of(from, uniform_eta, uniform_lambda);
  const int disc = patterns::lamella_between(from, 3, 4);
  ASSERT_GE(disc, 0);
  transport::TransferReport report;
  const state::FilmLiquid after =
      transport::transfer(parallel::Communicator::self(), from.films, from.topology, liquid, to.films,
                          to.topology, h, {}, report);
  EXPECT_LE(ledger_error(liquid, after), 1e-14);
  EXPECT_EQ(report.n_gone_lamellae, 1);
  const double held = patterns::held_by(from, liquid, disc);
  EXPECT_NEAR(report.from_gone, held, 1e-12 * held);
  EXPECT_NEAR(after.in_borders() - liquid.in_borders(), held, 1e-9 * held);
  // Only the ring near the disc got it: within 3 h of one of its vertices.
  const std::vector<double> length = mesh::border_dof_lengths(to.films, to.topology);
  for (std::size_t d = 0; d < length.size(); ++d) {
    const Vec3& x = to.films.position[to.topology.border_dof[d].vertex];
    const double gained = after.border_volume[d] / length[d] - lambda0;
    if (norm(x - Vec3{0, ring, 0}) < h) {
      EXPECT_GT(gained, 0.01 * lambda0);
    } else if (norm(x - centre) > (1.1 + 3) * h) {
      EXPECT_NEAR(gained, 0, 1e-9 * lambda0);
    }
  }
}

TEST(GoneLamella, FarFromBordersGivesItsLiquidToFilmsAround) {
  const Foam from = with_foreign_disc({}, 1.6 * h);
  const Foam to(shapes::double_bubble(radius, n_edges));
  const state::FilmLiquid liquid = patterns::liquid_of(from, uniform_eta, uniform_lambda);
  transport::TransferReport report;
  const state::FilmLiquid after =
      transport::transfer(parallel::Communicator::self(), from.films, from.topology, liquid, to.films,
                          to.topology, h, {}, report);
  EXPECT_LE(ledger_error(liquid, after), 1e-14);
  EXPECT_EQ(report.n_gone_lamellae, 1);
  EXPECT_NEAR(after.in_borders(), liquid.in_borders(), 1e-12 * liquid.in_borders());
  const int septum = patterns::lamella_between(to, 1, 2);
  const double expected = patterns::held_by(from, liquid, patterns::lamella_between(from, 1, 2)) +
                          patterns::held_by(from, liquid, patterns::lamella_between(from, 3, 4));
  EXPECT_NEAR(patterns::held_by(to, after, septum), expected, 1e-12 * expected);
}

// A bubble that split has pieces with new names. Their films are the old ones all the same.
TEST(RenamedBubble, KeepsTheLiquidOfItsFilmsInPlace) {
  const Foam from(shapes::double_bubble(radius, n_edges)), to = renamed(from.films, 2, 7);
  const auto eta = [](const Vec3& x) {
    return eta0 * (1 + 0.5 * x.y / radius + (x.x > 0.01 * radius ? 1 : 0));
  };
  const auto lambda = [](const Vec3& x) { return lambda0 * (1 + 0.5 * x.z / radius); };
  const state::FilmLiquid liquid = patterns::liquid_of(from, eta, lambda);
  transport::TransferReport report;
  const state::FilmLiquid after =
      transport::transfer(parallel::Communicator::self(), from.films, from.topology, liquid, to.films,
                          to.topology, h, {}, report);
  EXPECT_LE(ledger_error(liquid, after), 1e-14);
  EXPECT_EQ(report.n_born_lamellae + report.n_gone_lamellae + report.n_born_borders + report.n_gone_borders,
            0);
  for (const auto& [a, b, a_new, b_new] :
       {std::array{0, 1, 0, 1}, std::array{0, 2, 0, 7}, std::array{1, 2, 1, 7}}) {
    const double before = patterns::held_by(from, liquid, patterns::lamella_between(from, a, b));
    EXPECT_NEAR(patterns::held_by(to, after, patterns::lamella_between(to, a_new, b_new)), before,
                1e-12 * before);
  }
  const std::vector<double> length = mesh::border_dof_lengths(to.films, to.topology);
  for (std::size_t d = 0; d < length.size(); ++d)
    EXPECT_NEAR(after.border_volume[d] / length[d],
                lambda(to.films.position[to.topology.border_dof[d].vertex]), 1e-9 * lambda0);
}

TEST(Transfer, OntoAMeshWithoutFilmsIsRefused) {
  const Foam from(shapes::sphere({}, radius, 1, 1)), to{mesh::FilmMesh{}};
  const state::FilmLiquid liquid = patterns::liquid_of(from, uniform_eta, uniform_lambda);
  transport::TransferReport report;
  EXPECT_THROW(transport::transfer(parallel::Communicator::self(), from.films, from.topology, liquid,
                                   to.films, to.topology, h, {}, report),
               NumericalError);
}

}  // namespace
}  // namespace spume
