#include "spume/config/write_case.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "sample_case.hpp"
#include "spume/config/keys.hpp"
#include "spume/config/read_case.hpp"
#include "spume/config/value_text.hpp"
#include "spume/config/version.hpp"

namespace spume::config {
namespace {

using testing::HasSubstr;

/// A case in which no key of the table has its default.
simulation::Case unusual_case() {
  return parse_case(R"(
title = "quotes \" and \\ and é\nsecond line"
gravity = [0.1, -0.2, -9.81]
[domain]
lower = [-0.003, -0.004, -0.005]
upper = [0.003, 0.004, 0.005]
cells = [48, 64, 80]
boundary = ["wall", "slip", "periodic"]
[gas]
density = 1.2345678901234567
viscosity = 3.3333333333333335e-5
[liquid]
density = 1001
viscosity = 0.0011
[film]
surface_tension = 0.034
[foam]
lamella_half_thickness = 1e-6
border_area = 5e-8
equilibrate = true
remove_lamella = [[0, 2], [1, 2]]
[foam.cluster]
count = 5
mean_diameter = 0.0011
spread = 0.1
seed = 9007199254740993
center = [0, 0.0001, 0]
[[foam.bubble]]
shape = "sphere"
center = [0.0001, 0, 0]
radius = 0.001
[[foam.bubble]]
shape = "ellipsoid"
center = [0, 0.001, 0.0003]
semi_axes = [0.001, 0.0011, 0.0012]
[rearrangement]
max_time = 0.2
equilibrium_tolerance = 2e-3
cfl = 0.3
reconstruction_interval = 20
reconstruction_displacement = 0.5
conserve_volumes = false
interface = "viim"
epsilon = 2
dynamics = "quasistatic"
[drainage]
scheme = "paper"
max_time = 33
tolerance = 0.01
max_step = 2
edge_at_borders = 3e-5
edge_at_junctions = 1e-5
[rupture]
threshold = 1e-8
criterion = "node"
liquid = "spray"
protect = [[0, 1]]
corner_radius = 0
[cycle]
end_time = 12.5
max_ruptures = 3
stages = ["drain", "rupture"]
[output]
rearrangement_interval = 2e-3
drainage_interval = 3
gas = true
fields = ["pressure", "velocity"]
[flow]
elliptic = "multigrid"
)",
                    "unusual.toml");
}

/// Cases of the starts that exclude each other, again without defaults.
std::vector<simulation::Case> other_starts() {
  const std::string sides = "[domain]\nlower = [0, 0, 0]\nupper = [1, 1, 1]\ncells = [48, 48, 48]\n";
  return {
      parse_case(sides + "[foam.lattice]\nstructure = \"random\"\ncount = 30\nspread = 0.1\nseed = 7\n",
                 "random.toml"),
      parse_case(sides + "[foam.lattice]\nstructure = \"kelvin\"\ncells = 3\n", "crystal.toml"),
      parse_case(sides + "[foam.labels]\nfile = \"/foam.mha\"\nplacement = \"file\"\n", "labels.toml"),
      parse_case("[foam.films]\nfile = \"/films.vtp\"\nliquid = \"uniform\"\n[cycle]\nstages = [\"drain\"]\n",
                 "films.toml"),
      parse_case(
          sides + "boundary = [\"slip\", \"periodic\", \"periodic\"]\n[foam.membrane]\npoint = [0.5, 0, 0]\n"
                  "normal = [-2, 0, 0]\n[[foam.bubble]]\nshape = \"sphere\"\ncenter = [0.5, 0.5, 0.5]\n"
                  "radius = 0.2\n",
          "membrane.toml")};
}

TEST(WriteCase, gives_a_text_that_reads_back_to_the_same_values) {
  simulation::Case written = unusual_case();
  const std::string text = write_case(written);
  simulation::Case read = parse_case(text, "resolved.toml");
  EXPECT_EQ(write_case(read), text);
  for (const auto& key : case_keys())
    EXPECT_EQ(value_text(key.kind, read), value_text(key.kind, written)) << key.name;
  ASSERT_EQ(read.foam.bubble.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(read.foam.bubble[b].center, written.foam.bubble[b].center);
    EXPECT_EQ(read.foam.bubble[b].semi_axes, written.foam.bubble[b].semi_axes);
  }
  EXPECT_EQ(read.materials.gas.density, 1.2345678901234567) << "every digit";
  EXPECT_EQ(read.foam.cluster->seed, 9007199254740993u) << "beyond what a double holds";
  EXPECT_EQ(read.title, "quotes \" and \\ and é\nsecond line");
}

TEST(WriteCase, gives_every_start_back) {
  for (simulation::Case& written : other_starts()) {
    const std::string text = write_case(written);
    simulation::Case read = parse_case(text, "resolved.toml");
    EXPECT_EQ(write_case(read), text);
    for (const auto& key : case_keys())
      EXPECT_EQ(value_text(key.kind, read), value_text(key.kind, written)) << key.name;
  }
}

// The test above shows that a key is written and read only when its value differs from the default.
TEST(WriteCase, round_trip_covers_every_key) {
  simulation::Case defaults;
  std::vector<simulation::Case> unusual = other_starts();
  unusual.push_back(unusual_case());
  for (const auto& key : case_keys()) {
    const std::string usual = value_text(key.kind, defaults);
    EXPECT_TRUE(std::any_of(unusual.begin(), unusual.end(), [&](simulation::Case& c) {
      return value_text(key.kind, c) != usual;
    })) << key.name;
  }
}

TEST(WriteCase, has_the_version_and_the_defaults) {
  const std::string text = write_case(parse_case(sample_case, "sample.toml"));
  EXPECT_THAT(text, testing::StartsWith("# spume " + version()));
  EXPECT_THAT(text, HasSubstr("surface_tension = 0.03 "));
  EXPECT_THAT(text, HasSubstr("stages = [\"rearrange\", \"drain\", \"rupture\"]"));
  EXPECT_THAT(text, testing::Not(HasSubstr("[foam.cluster]"))) << "this case has no cluster";
}

}  // namespace
}  // namespace spume::config
