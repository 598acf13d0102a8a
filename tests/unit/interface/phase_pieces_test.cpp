#include "spume/interface/phase_pieces.hpp"

#include <gtest/gtest.h>

#include "analytic_foams.hpp"
#include "spume/interface/contour.hpp"
#include "spume/interface/find_films.hpp"
#include "spume/interface/smooth_area.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::interface {
namespace {

using testing::h;
using Kind = PhaseChange::Kind;

constexpr double smallest_volume = 2.5 * 2.5 * 2.5 * h * h * h;

/// One phase that fills several balls: signed distance to their union.
testing::Potential union_of(std::vector<testing::Ball> balls) {
  return [balls = std::move(balls)](mesh::Phase p, const Vec3& x) {
    double d = -1;
    for (const auto& b : balls) d = std::max(d, b.radius - norm(x - b.centre));
    return p == 1 ? d : -d;
  };
}

/// Separates until nothing is left to do, as find_films() does; gives the pieces in the end.
PhasePieces separate(PhasePotentials& potentials, state::Phases& phases, std::vector<PhaseChange>& changes) {
  for (int n = 0; n < 4; ++n)
    if (!separate_pieces(potentials, find_winners(potentials), phases, smallest_volume, changes)) break;
  return find_pieces(potentials.lattice(), find_winners(potentials));
}

TEST(PhasePieces, AreLinkedAlongTheEdgesOfTheTetrahedra) {
  const Index3 cells{4, 4, 4};
  std::vector<mesh::Phase> winner(64, 0);
  const auto set = [&](int i, int j, int k, mesh::Phase p) { winner[(k * 4 + j) * 4 + i] = p; };
  set(0, 0, 0, 1);
  set(1, 1, 1, 1);  // one step along all axes: linked
  set(2, 0, 2, 2);
  set(3, 1, 1, 2);  // steps of both signs: not linked
  const PhasePieces pieces = find_pieces(Lattice{cells}, winner);
  std::vector<int> of_phase(3, 0);
  for (const auto& piece : pieces.piece) ++of_phase[piece.phase];
  EXPECT_EQ(of_phase, (std::vector<int>{1, 1, 2}));
}

// Two cubes of 27 cells that touch at a corner, and a cell on a face of the upper one.
TEST(PhasePieces, OfATornBubbleAreNotLinkedThroughCornersAndKeepTheirCrumbs) {
  const Index3 cells{8, 8, 8};
  std::vector<mesh::Phase> winner(8 * 8 * 8, 0);
  const auto set = [&](int i, int j, int k, mesh::Phase p) { winner[(k * 8 + j) * 8 + i] = p; };
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        set(1 + i, 1 + j, 1 + k, 1);
        set(4 + i, 4 + j, 4 + k, 1);
      }
  set(5, 5, 3, 1);
  const auto sizes = [&](const TornBubbles& torn) {
    std::vector<std::size_t> n_cells;
    for (const PhasePiece& piece : find_pieces(Lattice{cells}, winner, torn).piece)
      if (piece.phase == 1) n_cells.push_back(piece.n_cells);
    return n_cells;
  };
  EXPECT_EQ(sizes({}), (std::vector<std::size_t>{55}));
  EXPECT_EQ(sizes({{1}, 10}), (std::vector<std::size_t>{27, 28}));
  set(5, 5, 3, 0);
  set(0, 0, 0, 1);  // a crumb that touches the lower cube at a corner
  EXPECT_EQ(sizes({{1}, 10}), (std::vector<std::size_t>{28, 27}));
  EXPECT_EQ(sizes({{2}, 10}), (std::vector<std::size_t>{55}));
  set(4, 4, 3, 1);  // shares an edge with the lower cube and a face with the upper one
  EXPECT_EQ(sizes({{1}, 10}), (std::vector<std::size_t>{56}));
}

FoundFilms found_films(PhasePotentials& potentials, state::Phases& phases,
                       std::vector<PhaseChange>& changes) {
  return find_films(parallel::Communicator::self(), potentials, find_winners(potentials), phases,
                    smallest_volume, changes);
}

/// Two balls about ±`centre`.
testing::Potential two_balls(const Vec3& centre) {
  return union_of({{-centre, 4.5 * h}, {centre, 4.5 * h}});
}

std::vector<mesh::Phase> torn_phases(const PhasePotentials& potentials, Pieces pieces) {
  const auto films = contour(parallel::Communicator::self(), potentials, find_winners(potentials), pieces);
  return torn_bubbles(h, closed_surfaces(films, mesh::build_topology(films)), smallest_volume).phase;
}

TEST(TornBubbles, AreTornAlongTheDiagonalOfACubeThatTetrahedraWouldLink) {
  // The two nearest cells of the balls are opposite corners of the cube in the middle; those of the others
  // are opposite corners of a face.
  const auto at_corner = testing::sampled(testing::cube_box(32), two_balls({3 * h, 3 * h, 3 * h}), 2),
             at_edge = testing::sampled(testing::cube_box(32), two_balls({3.5 * h, 3.5 * h, 0}), 2);
  EXPECT_EQ(torn_phases(at_corner, Pieces::OfCubes), std::vector<mesh::Phase>{1});
  EXPECT_TRUE(torn_phases(at_corner, Pieces::OfTetrahedra).empty());
  EXPECT_TRUE(torn_phases(at_edge, Pieces::OfCubes).empty());
  for (const auto* potentials : {&at_corner, &at_edge})
    EXPECT_EQ(find_pieces(potentials->lattice(), find_winners(*potentials)).piece.size(), 2u);
}

TEST(TornBubbles, BecomeTwo) {
  auto potentials = testing::sampled(testing::cube_box(32), two_balls({3 * h, 3 * h, 3 * h}), 2);
  auto phases = testing::unset_phases(1);
  phases.target_volume[1] = 7e-10;
  std::vector<PhaseChange> changes;
  const auto found = found_films(potentials, phases, changes);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, Kind::Split);
  EXPECT_EQ(phases.count(), 3);
  EXPECT_TRUE(torn_bubbles(h, closed_surfaces(found.films, found.topology), smallest_volume).phase.empty());
}

TEST(TornBubbles, AreNotLayersAcrossAPeriodicBox) {
  const auto layer = [](mesh::Phase p, const Vec3& x) {
    const double d = 5 * h - std::abs(x.x);
    return p == 0 ? -100 * h : p == 1 ? d : -d;
  };
  const auto potentials = testing::sampled(testing::cube_box(32), layer, 3);
  EXPECT_TRUE(torn_phases(potentials, Pieces::OfCubes).empty());
}

TEST(SeparatePieces, GivesALargePieceANewPhase) {
  auto potentials = testing::sampled(testing::cube_box(32),
                                     union_of({{{-6 * h, 0, 0}, 5 * h}, {{4 * h, 0.3 * h, 0}, 3 * h}}), 2);
  auto phases = testing::unset_phases(1);
  phases.target_volume[1] = 7e-10;
  std::vector<PhaseChange> changes;
  const auto found = found_films(potentials, phases, changes);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, Kind::Split);
  EXPECT_EQ(changes[0].other, 2);
  ASSERT_EQ(phases.count(), 3);
  // The targets share the old one in proportion to the volumes of the smooth films.
  const auto volume = smooth_phase_volumes(found.films, found.topology, 3);
  EXPECT_NEAR(phases.target_volume[1] + phases.target_volume[2], 7e-10, 1e-24);
  EXPECT_NEAR(phases.target_volume[2] / phases.target_volume[1], volume[2] / volume[1], 1e-12);
  EXPECT_NEAR(volume[2] / volume[1], 0.216, 0.01);  // (3/5)³, and what linear interpolation leaves out
  EXPECT_EQ(found.topology.n_nonconforming_edges, 0);
}

TEST(SeparatePieces, LeavesFilmsOfBothPiecesWhereTheyWere) {
  const auto balls = union_of({{{-6 * h, 0, 0}, 5 * h}, {{4 * h, 0.3 * h, 0}, 3 * h}});
  const auto before = testing::sampled(testing::cube_box(32), balls, 2);
  auto after = before;
  auto phases = testing::unset_phases(1);
  std::vector<PhaseChange> changes;
  separate(after, phases, changes);
  const auto one = contour(parallel::Communicator::self(), before, find_winners(before)),
             two = contour(parallel::Communicator::self(), after, find_winners(after));
  ASSERT_EQ(one.n_vertices(), two.n_vertices());
  for (int v = 0; v < one.n_vertices(); ++v) EXPECT_LT(norm(one.position[v] - two.position[v]), 1e-12 * h);
}

TEST(SeparatePieces, GivesASmallPieceToItsNeighbours) {
  auto potentials = testing::sampled(testing::cube_box(32),
                                     union_of({{{-6 * h, 0, 0}, 5 * h}, {{2 * h, 0.3 * h, 0}, 1.3 * h}}), 2);
  auto phases = testing::unset_phases(1);
  std::vector<PhaseChange> changes;
  const PhasePieces pieces = separate(potentials, phases, changes);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, Kind::Absorbed);
  EXPECT_EQ(changes[0].phase, 1);
  EXPECT_EQ(phases.count(), 2);
  EXPECT_EQ(pieces.piece.size(), 2u);
}

TEST(SeparatePieces, MakesAPhaseOfAnEnclosedPocketOfTheOutside) {
  const auto shell = [](mesh::Phase p, const Vec3& x) {
    const double d = std::min(8 * h - norm(x), norm(x) - 4 * h);
    return p == 1 ? d : -d;
  };
  auto potentials = testing::sampled(testing::cube_box(28), shell, 2);
  auto phases = testing::unset_phases(1);
  phases.target_volume[1] = 1e-9;
  std::vector<PhaseChange> changes;
  const auto found = found_films(potentials, phases, changes);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, Kind::Pocket);
  EXPECT_DOUBLE_EQ(phases.target_volume[2], smooth_phase_volumes(found.films, found.topology, 3)[2]);
  EXPECT_DOUBLE_EQ(phases.target_volume[1], 1e-9);
}

TEST(SuppressSpecks, RemovesABitOfAPhaseBetweenLatticePoints) {
  // Phase 2 is a ball, and largest in the middle of one lattice edge that crosses the film of the others.
  const auto foam = [](mesh::Phase p, const Vec3& x) {
    if (p < 2) return p == 0 ? x.x : -x.x;
    const Vec3 on_edge{std::clamp(x.x, -0.5 * h, 0.5 * h), 0.5 * h, 0.5 * h};
    return std::max(12 * h - 3 * norm(x - Vec3{5 * h, 5 * h, 5 * h}), 0.2 * h - 3 * norm(x - on_edge));
  };
  auto potentials = testing::sampled(testing::cube_box(24), foam, 3);
  const auto winners = find_winners(potentials);
  const auto films = contour(parallel::Communicator::self(), potentials, winners);
  EXPECT_EQ(suppress_specks(potentials, winners, closed_surfaces(films, mesh::build_topology(films)),
                            smallest_volume),
            1);
  const auto clean = contour(parallel::Communicator::self(), potentials, find_winners(potentials));
  EXPECT_EQ(suppress_specks(potentials, winners, closed_surfaces(clean, mesh::build_topology(clean)),
                            smallest_volume),
            0);
}

}  // namespace
}  // namespace spume::interface
