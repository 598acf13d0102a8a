#include "spume/config/read_case.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "sample_case.hpp"

namespace spume::config {
namespace {

using testing::ElementsAre;

TEST(ParseCase, reads_values_of_every_kind) {
  const simulation::Case run_case = parse_case(R"(
title = "two bubbles"
gravity = [0, 0, -9.8]
[domain]
lower = [0, 0, 0]
upper = [0.008, 0.008, 0.016]
cells = [32, 32, 64]
boundary = ["periodic", "wall", "slip"]
[gas]
density = 1.15
viscosity = 3.42e-5
[liquid]
density = 1000
[film]
surface_tension = 0.034
[foam]
equilibrate = true
remove_lamella = [[1, 2]]
[[foam.bubble]]
shape = "sphere"
center = [0.004, 0.004, 0.006]
radius = 0.0015
[[foam.bubble]]
shape = "ellipsoid"
center = [0.004, 0.004, 0.008]
semi_axes = [0.001, 0.0015, 0.002]
[rearrangement]
dynamics = "quasistatic"
[rupture]
criterion = "node"
liquid = "spray"
protect = [[0, 1], [0, 2]]
[cycle]
max_ruptures = 3
stages = ["rupture", "rearrange"]
[output]
fields = ["phase"]
[flow]
elliptic = "multigrid"
)",
                                               "two.toml");
  EXPECT_EQ(run_case.title, "two bubbles");
  EXPECT_EQ(run_case.materials.gravity, (Vec3{0, 0, -9.8}));
  EXPECT_EQ(run_case.box.upper, (Vec3{0.008, 0.008, 0.016}));
  EXPECT_EQ(run_case.box.cells, (Index3{32, 32, 64}));
  EXPECT_THAT(run_case.box.boundary,
              ElementsAre(grid::Boundary::Periodic, grid::Boundary::Wall, grid::Boundary::Slip));
  EXPECT_EQ(run_case.materials.gas.viscosity, 3.42e-5);
  EXPECT_EQ(run_case.materials.liquid.density, 1000) << "an integer does as a number";
  EXPECT_EQ(run_case.materials.liquid.viscosity, state::Liquid{}.viscosity) << "not written: the default";
  EXPECT_TRUE(run_case.foam.equilibrate);
  EXPECT_THAT(run_case.foam.remove_lamella, ElementsAre(std::array{1, 2}));
  ASSERT_EQ(run_case.foam.bubble.size(), 2u);
  EXPECT_EQ(run_case.foam.bubble[0].semi_axes, (Vec3{0.0015, 0.0015, 0.0015}));
  EXPECT_EQ(run_case.foam.bubble[1].semi_axes, (Vec3{0.001, 0.0015, 0.002}));
  EXPECT_FALSE(run_case.foam.cluster.has_value());
  EXPECT_EQ(run_case.rearrangement.dynamics, simulation::RearrangementParameters::Dynamics::Quasistatic);
  EXPECT_EQ(run_case.rupture.criterion, rupture::Criterion::Node);
  EXPECT_EQ(run_case.rupture.liquid, rupture::Fate::Spray);
  EXPECT_THAT(run_case.rupture.protect, ElementsAre(std::array{0, 1}, std::array{0, 2}));
  EXPECT_EQ(run_case.cycle.max_ruptures, 3);
  EXPECT_THAT(run_case.cycle.stages, ElementsAre(simulation::Stage::Rupture, simulation::Stage::Rearrange));
  EXPECT_THAT(run_case.output.fields, ElementsAre("phase"));
  EXPECT_EQ(run_case.flow.elliptic, grid::EllipticBackend::Multigrid);
}

TEST(ParseCase, makes_a_cluster_of_a_section_without_keys) {
  const auto run_case = parse_case(sample_domain + "[foam.cluster]\n", "c.toml");
  ASSERT_TRUE(run_case.foam.cluster.has_value());
  EXPECT_EQ(run_case.foam.cluster->count, simulation::ClusterShape{}.count);
  EXPECT_FALSE(run_case.foam.cluster->center.has_value());
}

TEST(ParseCase, reads_a_cluster_and_its_centre) {
  const auto run_case = parse_case(
      sample_domain + "[foam.cluster]\ncount = 4\nmean_diameter = 0.002\nseed = 77\ncenter = [0, 0, 0.001]\n",
      "c.toml");
  EXPECT_EQ(run_case.foam.cluster->count, 4);
  EXPECT_EQ(run_case.foam.cluster->mean_diameter, 0.002);
  EXPECT_EQ(run_case.foam.cluster->seed, 77u);
  EXPECT_EQ(run_case.foam.cluster->center, (Vec3{0, 0, 0.001}));
}

TEST(ParseCase, reads_a_lattice) {
  const auto run_case =
      parse_case(sample_domain + "[foam.lattice]\nstructure = \"weaire-phelan\"\ncells = 1\n", "c.toml");
  ASSERT_TRUE(run_case.foam.lattice.has_value());
  EXPECT_EQ(run_case.foam.lattice->structure, simulation::LatticeShape::Structure::WeairePhelan);
  EXPECT_EQ(run_case.foam.lattice->cells, 1);
}

TEST(ParseCase, finds_a_labelled_image_beside_the_case_file) {
  const std::string text = sample_domain + "[foam.labels]\nfile = \"scan/foam.mha\"\n";
  EXPECT_EQ(parse_case(text, "/data/run/c.toml").foam.labels->file, "/data/run/scan/foam.mha");
  const auto overridden = parse_case(text, "/data/run/c.toml", {R"(foam.labels.file="other.vti")"});
  EXPECT_EQ(overridden.foam.labels->file, (std::filesystem::current_path() / "other.vti").string())
      << "on the command line, where the program runs";
}

TEST(ParseCase, counts_the_gas_above_a_membrane_as_the_last_phase) {
  const std::string text =
      sample_case + "[foam.membrane]\npoint = [0, 0, 0]\n[rupture]\nprotect = [[0, 2]]\n";
  const auto run_case = parse_case(text, "c.toml", {R"(domain.boundary=["periodic", "periodic", "slip"])"});
  ASSERT_TRUE(run_case.foam.membrane.has_value());
  EXPECT_EQ(run_case.foam.membrane->normal, (Vec3{0, 0, 1}));
}

TEST(ParseCase, lets_options_override_the_file_and_the_last_option_win) {
  const auto run_case =
      parse_case(sample_case + "[cycle]\nend_time = 5\n", "c.toml",
                 {"cycle.end_time=7", "cycle.end_time=9.5", "title=short", "flow.elliptic=multigrid",
                  "cycle.stages=[\"drain\"]", "gas.density = 2"});
  EXPECT_EQ(run_case.cycle.end_time, 9.5);
  EXPECT_EQ(run_case.title, "short") << "one bare word is text, since a shell takes the quotes away";
  EXPECT_EQ(run_case.flow.elliptic, grid::EllipticBackend::Multigrid);
  EXPECT_THAT(run_case.cycle.stages, ElementsAre(simulation::Stage::Drain));
  EXPECT_EQ(run_case.materials.gas.density, 2);
}

TEST(ParseCase, takes_volume_conservation_for_steps_and_reconstructions_from_one_key) {
  const auto run_case = parse_case(sample_case, "c.toml", {"rearrangement.conserve_volumes=false"});
  EXPECT_FALSE(run_case.rearrangement.conserve_volumes);
  EXPECT_FALSE(run_case.reconstruct.conserve_volumes);
}

TEST(ParseCase, makes_a_section_from_an_option) {
  const auto run_case = parse_case(sample_case, "c.toml", {"foam.cluster.count=3"});
  ASSERT_TRUE(run_case.foam.cluster.has_value());
  EXPECT_EQ(run_case.foam.cluster->count, 3);
}

}  // namespace
}  // namespace spume::config
