#include "spume/interface/reconstruct.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "analytic_foams.hpp"
#include "spume/base/error.hpp"
#include "spume/interface/contour.hpp"
#include "spume/interface/phase_pieces.hpp"
#include "spume/interface/relax.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::interface {
namespace {

using testing::h;
using Kind = PhaseChange::Kind;

// Minimal cluster of four equal bubbles, radii of the outer films R.
constexpr double cluster_area = 33.499028379;   // R²
constexpr double cluster_volume = 2.791585698;  // of each, R³

/// Film area over that of the exact cluster of the same volumes, less one.
double area_error(const mesh::FilmMesh& films) {
  const auto volume = mesh::phase_volumes(films, 5);
  const double radius = std::cbrt(0.25 * (volume[1] + volume[2] + volume[3] + volume[4]) / cluster_volume);
  return mesh::film_area(films) / (cluster_area * radius * radius) - 1;
}

double volume_error(const mesh::FilmMesh& films, const state::Phases& phases) {
  const auto volume = mesh::phase_volumes(films, phases.count());
  double error = 0;
  for (int p = 1; p < phases.count(); ++p)
    if (phases.alive(p)) error = std::max(error, std::abs(volume[p] / phases.target_volume[p] - 1));
  return error;
}

/// Number of closed surfaces that bound each phase: one for a bubble without stray pieces.
int n_closed_surfaces(const mesh::FilmMesh& films, mesh::Phase phase) {
  mesh::FilmMesh surface{films.position, {}, films.domain};
  for (const auto& t : films.triangle)
    if (t.phase_a == phase || t.phase_b == phase) surface.triangle.push_back({t.vertex, 0, 1});
  return mesh::build_topology(surface).n_lamellae();
}

TEST(Construct, OfFourEqualBubblesFindsTheTetrahedralCluster) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(36));
  auto phases = testing::unset_phases(4);
  const auto result =
      construct(grid, testing::power_diagram(testing::tetrahedral_cluster(8 * h)), phases, {});
  const auto topology = mesh::build_topology(result.films);
  EXPECT_EQ(topology.n_lamellae(), 10);
  EXPECT_EQ(topology.n_borders(), 10);
  EXPECT_EQ(topology.n_junctions(), 5);
  EXPECT_EQ(result.report.n_nonconforming_edges, 0);
  EXPECT_EQ(result.report.n_refused_projections, 0);
  EXPECT_TRUE(result.report.changes.empty());
  // The functions' volumes are found by linear interpolation with vertices on the films: 0.2 %, measured.
  for (int p = 1; p <= 4; ++p)
    EXPECT_NEAR(phases.target_volume[p] / (cluster_volume * std::pow(8 * h, 3)), 1, 4e-3);
  EXPECT_LT(volume_error(result.films, phases), 1e-9);
}

TEST(Construct, KeepsTheWantedVolumes) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(24));
  auto phases = testing::unset_phases(1);
  const double wanted = 4 * std::numbers::pi / 3 * std::pow(6 * h, 3);
  phases.target_volume[1] = wanted;
  const auto result = construct(grid, testing::power_diagram({{{}, 6 * h}}), phases, {});
  EXPECT_EQ(phases.target_volume[1], wanted);
  EXPECT_NEAR(mesh::phase_volumes(result.films, 2)[1] / wanted, 1, 1e-9);
}

TEST(Construct, ReportsPocketsAndSwallowedBubbles) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(28));
  // Phase 1 is a thick shell, phase 2 is nowhere largest.
  const auto shell = [](mesh::Phase p, const Vec3& x) {
    const double d = std::min(9 * h - norm(x), norm(x) - 4 * h);
    return p == 0 ? -d : p == 1 ? d : -20 * h;
  };
  auto phases = testing::unset_phases(2);
  const auto result = construct(grid, shell, phases, {});
  ASSERT_EQ(result.report.changes.size(), 2u);
  EXPECT_EQ(result.report.changes[0].kind, Kind::Pocket);
  EXPECT_EQ(result.report.changes[0].other, 3);
  EXPECT_EQ(result.report.changes[1].kind, Kind::Lost);
  EXPECT_EQ(result.report.changes[1].phase, 2);
  EXPECT_FALSE(phases.alive(2));
  EXPECT_LT(volume_error(result.films, phases), 1e-9);
  EXPECT_NEAR(phases.target_volume[3] / (4 * std::numbers::pi / 3 * std::pow(4 * h, 3)), 1, 0.02);
}

TEST(Construct, RefusesFilmsNearAWall) {
  const grid::Grid grid(parallel::Communicator::world(), testing::walled(testing::cube_box(24)));
  auto phases = testing::unset_phases(1);
  EXPECT_THROW(construct(grid, testing::power_diagram({{{}, 8.5 * h}}), phases, {}), InputError);
}

TEST(Reconstruct, TwentyTimesWithoutFlowKeepsTheClusterAtRest) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(36));
  auto phases = testing::unset_phases(4);
  auto result = construct(grid, testing::power_diagram(testing::tetrahedral_cluster(8 * h)), phases, {});
  const auto targets = phases.target_volume;
  for (int n = 0; n < 20; ++n) {
    result = reconstruct(grid, result.films, phases, {});
    ASSERT_EQ(result.report.n_nonconforming_edges, 0);
    ASSERT_EQ(result.report.n_refused_projections, 0);
    ASSERT_TRUE(result.report.changes.empty());
    // Measured 7.4e-4 to 7.8e-4, of which inscribed triangles are most.
    ASSERT_LT(std::abs(area_error(result.films)), 1.5e-3) << n;
    ASSERT_LT(volume_error(result.films, phases), 1e-9);
  }
  EXPECT_EQ(phases.target_volume, targets);
  const auto topology = mesh::build_topology(result.films);
  EXPECT_EQ(topology.n_lamellae(), 10);
  EXPECT_EQ(topology.n_junctions(), 5);
}

TEST(Reconstruct, KeepsTheAreaAndVolumeOfASphere) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(32));
  auto phases = testing::unset_phases(1);
  const double volume = 4 * std::numbers::pi / 3 * std::pow(8 * h, 3);
  phases.target_volume[1] = volume;
  auto result = construct(grid, testing::power_diagram({{{0.2 * h, 0.1 * h, 0.4 * h}, 8 * h}}), phases, {});
  const double area = mesh::film_area(result.films);
  for (int n = 0; n < 5; ++n) {
    result = reconstruct(grid, result.films, phases, {});
    EXPECT_NEAR(mesh::film_area(result.films) / area, 1, 1e-4);
    // Inscribed triangles with edges of about h at R = 8 h; 9.3e-4 measured.
    EXPECT_NEAR(mesh::film_area(result.films) / (4 * std::numbers::pi * 64 * h * h), 1, 1e-3);
    EXPECT_NEAR(mesh::phase_volumes(result.films, 2)[1] / volume, 1, 1e-9);
  }
}

// Relaxed until the area falls no more, so that every rise is the work of the reconstruction; 8e-6 measured,
// and 8.7e-5 without settling.
TEST(Reconstruct, HardlyRaisesTheAreaOfAFoamAtRest) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(36));
  auto phases = testing::unset_phases(4);
  const auto start = construct(grid, testing::power_diagram(testing::tetrahedral_cluster(8 * h)), phases, {});
  mesh::FilmMesh films = start.films;
  const mesh::Topology topology = mesh::build_topology(films);
  for (int n = 0; n < 40; ++n) relax_step(films, topology, phases, 3 * h * h);
  const double area = mesh::film_area(films);
  const auto rise = [&](double relaxation) {
    ReconstructParameters parameters;
    parameters.relaxation = relaxation;
    return mesh::film_area(reconstruct(grid, films, phases, parameters).films) / area - 1;
  };
  const double settled = rise(ReconstructParameters{}.relaxation), unsettled = rise(0);
  EXPECT_LT(settled, 2e-5);
  EXPECT_LT(settled, 0.3 * unsettled);
}

// Settling is curvature flow, which would take 0.4 h² · (n − 1)(n + 2)/R² = 2.5 % of the mode n = 2 of this
// bubble; the longer step in advance gives it back. 1.7 % lost in four times, measured.
TEST(Reconstruct, KeepsTheShapeOfAnEllipsoid) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(32));
  auto phases = testing::unset_phases(1);
  const Vec3 centre{0.2 * h, 0.1 * h, 0.4 * h}, axes{7.6 * h, 7.6 * h, 8.8 * h};
  const auto ellipsoid = [&](mesh::Phase p, const Vec3& x) {
    double s = 0;
    for (int d = 0; d < 3; ++d) s += (x[d] - centre[d]) * (x[d] - centre[d]) / (axes[d] * axes[d]);
    return (p == 1 ? 1 : -1) * 4 * h * (1 - s);
  };
  // From the second moments of the volume, the sums of those of tetrahedra; the farthest vertex would tell
  // where vertices happen to lie.
  const auto elongation = [&](const mesh::FilmMesh& films) {
    Vec3 moment;
    for (int t = 0; t < films.n_triangles(); ++t) {
      auto [a, b, c] = films.corners(t);
      a -= centre;
      b -= centre;
      c -= centre;
      const double volume = dot(a, cross(b, c));
      for (int d = 0; d < 3; ++d)
        moment[d] += volume * (a[d] * a[d] + b[d] * b[d] + c[d] * c[d] + std::pow(a[d] + b[d] + c[d], 2));
    }
    return moment.z / (0.5 * (moment.x + moment.y)) - 1;
  };
  auto result = construct(grid, ellipsoid, phases, {});
  const double before = elongation(result.films);
  for (int n = 0; n < 4; ++n) result = reconstruct(grid, result.films, phases, {});
  EXPECT_NEAR(elongation(result.films) / before, 1, 0.03);  // 10 % without the step in advance
}

TEST(Reconstruct, SplitsADumbbellWhoseNeckIsThinnerThanTheGrid) {
  const grid::Box box = testing::cube_box(36);
  const grid::Grid grid(parallel::Communicator::world(), box);
  const auto dumbbell = [](mesh::Phase p, const Vec3& x) {
    const Vec3 on_axis{std::clamp(x.x, -8 * h, 8 * h), 0.2 * h, -0.1 * h};
    const double d = std::max({0.6 * h - norm(x - on_axis), 5 * h - norm(x - Vec3{-8 * h, 0, 0}),
                               4 * h - norm(x - Vec3{8 * h, 0, 0})});
    return p == 1 ? d : -d;
  };
  const auto potentials = testing::sampled(box, dumbbell, 2);
  const auto films = contour(parallel::Communicator::self(), potentials, find_winners(potentials));
  ASSERT_EQ(n_closed_surfaces(films, 1), 1) << "one bubble to begin with";
  auto phases = testing::unset_phases(1);
  const double volume = mesh::phase_volumes(films, 2)[1];
  phases.target_volume[1] = volume;
  const auto result = reconstruct(grid, films, phases, {});
  ASSERT_EQ(result.report.changes.size(), 1u);
  const auto& change = result.report.changes[0];
  EXPECT_EQ(change.kind, Kind::Split);
  EXPECT_EQ(change.other, 2);
  EXPECT_NEAR(phases.target_volume[1] + phases.target_volume[2], volume, 1e-14 * volume);
  EXPECT_NEAR(phases.target_volume[2] / phases.target_volume[1], 64.0 / 125,
              0.05);  // spheres; the neck is shared
  EXPECT_LT(volume_error(result.films, phases), 1e-9);
  EXPECT_EQ(n_closed_surfaces(result.films, 1), 1);
  EXPECT_EQ(n_closed_surfaces(result.films, 2), 1);
  EXPECT_EQ(result.report.n_nonconforming_edges, 0);
}

TEST(Reconstruct, GivesTheGasOfATinyBubbleToTheNeighbourWithMostCommonFilm) {
  const grid::Box box = testing::cube_box(36);
  const grid::Grid grid(parallel::Communicator::world(), box);
  // Bubble 3 is a small ball on the film of bubbles 1 and 2, most of it on the side of 2.
  const auto two = testing::power_diagram({{{-5 * h, 0, 0}, 6 * h}, {{5 * h, 0, 0}, 6 * h}});
  const auto foam = [&](mesh::Phase p, const Vec3& x) {
    if (p < 3) return two(p, x);
    return std::max({two(0, x), two(1, x), two(2, x)}) + 1.4 * h - norm(x - Vec3{0.6 * h, 0.3 * h, 0.2 * h});
  };
  const auto potentials = testing::sampled(box, foam, 4);
  const auto films = contour(parallel::Communicator::self(), potentials, find_winners(potentials));
  auto phases = testing::unset_phases(3);
  const auto volume = mesh::phase_volumes(films, 4);
  std::copy(volume.begin() + 1, volume.end(), phases.target_volume.begin() + 1);
  ASSERT_GT(volume[3], 0);
  ASSERT_LT(volume[3], std::pow(2.5 * h, 3));
  const auto result = reconstruct(grid, films, phases, {});
  ASSERT_EQ(result.report.changes.size(), 1u);
  EXPECT_EQ(result.report.changes[0].kind, Kind::Lost);
  EXPECT_EQ(result.report.changes[0].phase, 3);
  EXPECT_DOUBLE_EQ(result.report.changes[0].volume, volume[3]);
  EXPECT_EQ(phases.target_volume[3], 0);
  EXPECT_EQ(result.report.changes[0].other, 2);
  EXPECT_DOUBLE_EQ(phases.target_volume[1], volume[1]);
  EXPECT_DOUBLE_EQ(phases.target_volume[2], volume[2] + volume[3]);
  EXPECT_EQ(n_closed_surfaces(result.films, 3), 0);
  EXPECT_LT(volume_error(result.films, phases), 1e-9);
}

TEST(Reconstruct, RefusesFilmsThatHaveDriftedToAWall) {
  const grid::Grid grid(parallel::Communicator::world(), testing::walled(testing::cube_box(24)));
  auto phases = testing::unset_phases(1);
  phases.target_volume[1] = 1e-10;
  EXPECT_THROW(reconstruct(grid, testing::icosphere({5 * h, 0, 0}, 4 * h, 2), phases, {}), NumericalError);
}

/// Balls of a power diagram moved by whole cells, as a periodic box sees them.
testing::Potential moved_by(const std::vector<testing::Ball>& balls, const Index3& cells,
                            const grid::Box& box) {
  return
      [diagram = testing::power_diagram(balls), shift = h * Vec3{1.0 * cells.i, 1.0 * cells.j, 1.0 * cells.k},
       domain = box.domain()](mesh::Phase p, const Vec3& x) { return diagram(p, domain.inside(x - shift)); };
}

// The same bubbles in the middle of the box and over its corner. Positions differ by their rounding and the
// order of sums; what the foam is does not.
TEST(Reconstruct, DoesNotSeeThePeriodicFacesOfTheBox) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(36));
  const auto balls = testing::tetrahedral_cluster(8 * h);
  std::array<Reconstruction, 2> result;
  std::array<state::Phases, 2> phases{testing::unset_phases(4), testing::unset_phases(4)};
  for (int n = 0; n < 2; ++n) {
    const Index3 cells = n == 0 ? Index3{0, 0, 0} : Index3{17, 18, -15};
    result[n] = construct(grid, moved_by(balls, cells, grid.box()), phases[n], {});
    result[n] = reconstruct(grid, result[n].films, phases[n], {});
    EXPECT_EQ(result[n].report.n_nonconforming_edges, 0);
    EXPECT_EQ(result[n].report.n_refused_projections, 0);
    EXPECT_LT(volume_error(result[n].films, phases[n]), 1e-6);
  }
  const auto here = mesh::build_topology(result[0].films), there = mesh::build_topology(result[1].films);
  EXPECT_EQ(here.n_lamellae(), there.n_lamellae());
  EXPECT_EQ(here.n_borders(), there.n_borders());
  EXPECT_EQ(here.n_junctions(), there.n_junctions());
  // The ties are broken by noise of 1e-7 h that does not move along, and remeshing amplifies it: meshes
  // differ, their areas by a part of the error of either (7e-4).
  EXPECT_NEAR(mesh::film_area(result[1].films) / mesh::film_area(result[0].films), 1, 1e-4);
  EXPECT_NEAR(phases[1].target_volume[1] / phases[0].target_volume[1], 1, 1e-5);
}

// A film across the box, between slip walls below and above, is a layer on either side.
TEST(Reconstruct, KeepsAFilmThatCrossesTheBox) {
  grid::Box box = testing::cube_box(24);
  box.boundary[2] = grid::Boundary::Slip;
  const grid::Grid grid(parallel::Communicator::world(), box);
  auto phases = testing::unset_phases(1);
  const double k = 2 * M_PI / (24 * h);
  const auto wave = [&](mesh::Phase p, const Vec3& x) {
    const double above = x.z - 0.1 * h - 2 * h * std::cos(k * x.x);
    return p == 1 ? above : -above;
  };
  const auto result = construct(grid, wave, phases, {});
  const auto topology = mesh::build_topology(result.films);
  EXPECT_EQ(topology.n_nonconforming_edges, 0);
  EXPECT_EQ(topology.n_lamellae(), 1);
  EXPECT_EQ(topology.n_borders(), 0);
  // The mean of the wave is 0.1 h.
  EXPECT_NEAR(phases.target_volume[1] / (24 * 24 * h * h), 11.9 * h, 2e-3 * h);
  double highest = 0;
  for (const Vec3& x : result.films.position) highest = std::max(highest, x.z);
  EXPECT_NEAR(highest, 2.1 * h, 0.02 * h);
}

// By 0.003 h where that is not undone in advance.
TEST(Reconstruct, DoesNotShiftAFlatFilmWhereverItLiesInItsCells) {
  for (const int axis : {0, 2})
    for (const double sign : {1.0, -1.0}) {
      grid::Box box = testing::cube_box(24);
      box.boundary[axis] = grid::Boundary::Slip;
      const Vec3 offset = 0.37 * h * Vec3{1, 1, 1};
      box.lower += offset;
      box.upper += offset;
      const grid::Grid grid(parallel::Communicator::world(), box);
      for (const double height : {0.1, 0.2, 0.3, 0.4, 0.7}) {  // [h], above a face of the cells
        const double place = height * h + offset[axis];
        auto phases = testing::unset_phases(1);
        const auto side = [&](mesh::Phase p, const Vec3& x) {
          return (p == 1 ? sign : -sign) * (x[axis] - place);
        };
        auto films = construct(grid, side, phases, {}).films;
        for (Vec3& x : films.position) x[axis] = place;
        const auto result = reconstruct(grid, films, phases, {.conserve_volumes = false});
        ASSERT_FALSE(result.films.position.empty());
        for (const Vec3& x : result.films.position)
          ASSERT_NEAR(x[axis], place, 1e-3 * h) << axis << " " << sign << " " << height;
      }
    }
}

TEST(Reconstruct, OfNoFilmsIsNoFilms) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(16));
  state::Phases phases;
  const auto result = reconstruct(grid, {}, phases, {});
  EXPECT_EQ(result.films.n_triangles(), 0);
  EXPECT_TRUE(result.report.changes.empty());
}

TEST(Reconstruct, KeepsRandomClustersConformingAndWhole) {
  const grid::Grid grid(parallel::Communicator::world(), testing::cube_box(48));
  auto phases = testing::unset_phases(12);
  auto result = construct(grid, testing::power_diagram(testing::random_balls(12, 6 * h, 3)), phases, {});
  for (int n = 0; n < 3; ++n) {
    result = reconstruct(grid, result.films, phases, {});
    EXPECT_EQ(result.report.n_nonconforming_edges, 0);
    for (int p = 1; p < phases.count(); ++p)
      EXPECT_EQ(n_closed_surfaces(result.films, p), phases.alive(p)) << p;
    EXPECT_LT(volume_error(result.films, phases), 1e-8);
  }
}

}  // namespace
}  // namespace spume::interface
