#include "spume/interface/project_junction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "analytic_foams.hpp"
#include "spume/interface/contour.hpp"

namespace spume::interface {
namespace {

using testing::h;

const Vec3 middle{0.137 * h, 0.371 * h, 0.219 * h};  // off the lattice
const Vec3 along = normalized(Vec3{1, 0.37, 0.23});

/// Four bubbles about a line through the middle, askew to the grid: 0 and 1 opposite each other, and 2 and 3.
/// At s [h] along the line 0 and 1 are larger by 2 lead(s) h, which is where they share a film, and where
/// lead < 0 the others do. Bubble 4 is beyond s = end, if there is one.
template <typename Lead>
testing::Potential four_about_a_line(Lead lead, double end = 1e3) {
  return [=](mesh::Phase p, const Vec3& x) {
    const Vec3 first = normalized(cross(along, Vec3{0.2, 0, 1})), second = cross(along, first);
    const double u = dot(x - middle, first), v = dot(x - middle, second), s = dot(x - middle, along) / h;
    if (p == 4) return (s - end) * h;
    return p < 2 ? (p == 0 ? u : -u) + lead(s) * h : (p == 2 ? v : -v) - lead(s) * h;
  };
}

struct Junction {
  Vec3 at;                  // in the contour
  std::optional<Vec3> tie;  // that Newton's method finds
  std::optional<Vec3> projected;
};

/// The junctions of the contour of `drawn` near the middle, in the order of s, projected onto `smooth`.
std::vector<Junction> project_junctions_of(const testing::Potential& drawn, const testing::Potential& smooth,
                                           int n_phases) {
  const grid::Box box = testing::walled(testing::cube_box(16));
  const auto drawn_fields = testing::sampled(box, drawn, n_phases);
  const auto potentials = testing::sampled(box, smooth, n_phases);
  const auto films = contour(parallel::Communicator::self(), drawn_fields, find_winners(drawn_fields));
  const auto topology = mesh::build_topology(films);
  std::vector<Junction> junctions;
  for (int v : topology.junction)
    junctions.push_back({films.position[v], potentials.project(films.position[v], topology.vertex_phases[v]),
                         project_junction(potentials, films, topology, v)});
  std::ranges::sort(junctions, {}, [](const Junction& j) { return dot(j.at, along); });
  return junctions;
}

TEST(ProjectJunction, PutsAJunctionWhereItsFourPhasesTie) {
  for (double side : {1.0, -1.0}) {  // of either handedness
    const auto drawn = four_about_a_line([=](double s) { return side * 0.2 * s; });
    const auto smooth = four_about_a_line([=](double s) { return side * 0.2 * (s - 0.3); });
    const auto junctions = project_junctions_of(drawn, smooth, 4);
    ASSERT_EQ(junctions.size(), 1u);
    ASSERT_TRUE(junctions[0].projected);
    // Cubic interpolation is exact for linear functions: round-off and the end of Newton's method.
    EXPECT_LT(norm(*junctions[0].projected - middle - 0.3 * h * along), 1e-8 * h);
  }
}

// A contour with junctions at s = −1.1, 0 and 1.1 of potentials that have one, at 0: the middle one has its
// films the other way about, and the outer ones would come to lie on the same point.
TEST(ProjectJunction, LeavesJunctionsThatThePotentialsDoNotHave) {
  const auto drawn = four_about_a_line([](double s) { return 0.3 * s * (s * s - 1.21); });
  const auto smooth = four_about_a_line([](double s) { return 0.2 * s; });
  const auto junctions = project_junctions_of(drawn, smooth, 4);
  ASSERT_EQ(junctions.size(), 3u);
  EXPECT_TRUE(junctions[1].tie) << "too far for the test to tell";
  for (const Junction& j : junctions) EXPECT_FALSE(j.projected) << dot(j.at - middle, along) / h;
}

// Before bubble 4 the contour still has the film of 0 and 1, and the potentials that of 2 and 3, after a T1.
TEST(ProjectJunction, LeavesAJunctionThatWouldComeToLieInAnotherBubble) {
  const auto drawn = four_about_a_line([](double) { return 0.1; }, 0.2);
  const auto smooth = four_about_a_line([](double) { return -0.1; }, 0.2);
  const auto same = project_junctions_of(drawn, drawn, 5), other = project_junctions_of(drawn, smooth, 5);
  ASSERT_EQ(same.size(), 2u);
  for (int n = 0; n < 2; ++n) {
    EXPECT_TRUE(same[n].projected);
    EXPECT_TRUE(other[n].tie) << "too far for the test to tell";
    EXPECT_FALSE(other[n].projected);
  }
}

}  // namespace
}  // namespace spume::interface
