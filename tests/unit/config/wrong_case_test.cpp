#include <gmock/gmock.h>

#include <algorithm>

#include "sample_case.hpp"
#include "spume/base/error.hpp"
#include "spume/config/read_case.hpp"

namespace spume::config {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The report on a wrong case; empty when the case was taken for right.
std::string report(const std::string& text, const std::vector<std::string>& options = {}) {
  try {
    parse_case(text, "wrong.toml", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(WrongCase, unknown_key_has_its_place_and_the_nearest_key) {
  EXPECT_EQ(report(sample_case + "[gas]\ndensty = 1\n"),
            "wrong.toml:10:1: unknown key 'gas.densty'; did you mean 'gas.density'?");
}

TEST(WrongCase, key_far_from_all_others_gets_the_list_of_its_section) {
  EXPECT_THAT(report(sample_case + "[gas]\ntemperature = 300\n"),
              HasSubstr("unknown key 'gas.temperature'; [gas] has density, viscosity"));
}

TEST(WrongCase, misspelt_section_is_one_problem_whatever_it_holds) {
  EXPECT_EQ(report(sample_case + "[rearangement]\ncfl = 0.5\nmax_time = 1\n"),
            "wrong.toml:9:2: unknown section 'rearangement'; did you mean 'rearrangement'?");
  EXPECT_THAT(report(sample_domain + "[[foam.bubbles]]\nradius = 1\n"),
              HasSubstr("unknown section 'foam.bubbles'; did you mean 'foam.bubble'?"));
}

TEST(WrongCase, wrong_type_says_what_is_wanted_and_what_was_found) {
  EXPECT_EQ(report(sample_case + "[gas]\ndensity = \"air\"\n"),
            "wrong.toml:10:11: 'gas.density' must be a number > 0, not the text \"air\"");
  EXPECT_THAT(report(sample_case + "[foam]\nequilibrate = 1\n"),
              HasSubstr("'foam.equilibrate' must be true or false, not 1"));
  EXPECT_THAT(report(sample_case + "[cycle]\nmax_ruptures = 2.5\n"),
              HasSubstr("'cycle.max_ruptures' must be a whole number ≥ 0, not 2.5"));
  EXPECT_THAT(report("gravity = [0, 0]\n" + sample_case),
              HasSubstr("'gravity' must be an array of three numbers, not [0, 0]"));
  EXPECT_THAT(report("domain = 5\n" + sample_bubble), HasSubstr("'domain' is a section"));
  EXPECT_THAT(report(sample_case + "[foam]\nremove_lamella = [1, 2]\n"),
              HasSubstr("a list of pairs of phases"));
}

TEST(WrongCase, value_out_of_range_is_told_with_the_range) {
  EXPECT_THAT(report(sample_case + "[gas]\ndensity = -1\n"),
              HasSubstr("'gas.density' must be a number > 0, not -1"));
  EXPECT_THAT(report(sample_case + "[gas]\ndensity = nan\n"),
              HasSubstr("'gas.density' must be a number > 0"));
  EXPECT_THAT(report(sample_case + "[gas]\ndensity = inf\n"),
              HasSubstr("'gas.density' must be a number > 0"));
  EXPECT_THAT(report(sample_case + "[rearrangement]\ncfl = 1.5\n"), HasSubstr("> 0, ≤ 0.5, not 1.5"));
  EXPECT_THAT(report(sample_case, {"foam.cluster.seed=-3"}), HasSubstr("must be a whole number ≥ 0, not -3"));
  EXPECT_THAT(report(sample_case, {"cycle.max_ruptures=3000000000"}), HasSubstr("must be a whole number"));
}

TEST(WrongCase, name_that_is_no_choice_is_told_with_the_choices) {
  EXPECT_THAT(report(sample_case, {R"(domain.boundary=["wall", "wall", "walls"])"}),
              AllOf(HasSubstr("'domain.boundary'"), HasSubstr("\"periodic\", \"wall\", \"slip\""),
                    HasSubstr("not the text \"walls\"; did you mean 'wall'?")));
  EXPECT_THAT(report(sample_case, {R"(cycle.stages=["rearrange", "melt"])"}),
              HasSubstr("not the text \"melt\""));
  EXPECT_THAT(report(sample_case, {R"(cycle.stages=["drain", "drain"])"}),
              HasSubstr("names \"drain\" twice"));
  EXPECT_THAT(report(sample_case, {"cycle.stages=[]"}), HasSubstr("a list of one or more of"));
}

TEST(WrongCase, all_problems_are_in_one_report_in_the_order_of_the_file) {
  const std::string text = report(sample_case + "[gas]\nviscosity = -1\ndensty = 1\n[cycle]\nstages = 3\n");
  EXPECT_EQ(std::ranges::count(text, '\n'), 2) << text;
  const auto first = text.find("gas.viscosity"), second = text.find("gas.densty"),
             third = text.find("cycle.stages");
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_NE(third, std::string::npos);
}

TEST(WrongCase, syntax_error_has_its_place) {
  EXPECT_THAT(report("title = \n"), testing::StartsWith("wrong.toml:1:"));
  EXPECT_THAT(report(sample_case + "[gas]\ndensity = 1\ndensity = 2\n"),
              testing::StartsWith("wrong.toml:11:"));
  EXPECT_THAT(report(sample_case + "[gas]\ndensity = 1\n[gas]\nviscosity = 2\n"),
              testing::StartsWith("wrong.toml:11:"));
}

TEST(WrongCase, missing_keys_are_named) {
  const std::string text = report("[domain]\nlower = [0, 0, 0]\n" + sample_bubble);
  EXPECT_THAT(text, AllOf(HasSubstr("wrong.toml:1:2: missing key 'domain.upper'"),
                          HasSubstr("missing key 'domain.cells'")));
}

TEST(WrongCase, cells_that_are_no_cubes_are_told_with_their_edges) {
  EXPECT_THAT(report(sample_case, {"domain.cells=[32, 32, 40]"}),
              AllOf(HasSubstr("--set domain.cells=[32, 32, 40]: cells must be cubes"),
                    HasSubstr("0.00025 × 0.00025 × 0.0002 m")));
}

TEST(WrongCase, box_needs_an_inside_and_enough_cells) {
  EXPECT_THAT(report(sample_case, {"domain.upper=[0.004, -0.004, 0.004]"}),
              HasSubstr("'domain.upper' must be larger than 'domain.lower' along y"));
  EXPECT_THAT(report(sample_case, {"domain.cells=[8, 8, 8]"}), HasSubstr("three whole numbers ≥ 16"));
}

TEST(WrongCase, bubble_too_near_to_the_edge_of_the_box_is_told_with_its_reach) {
  EXPECT_EQ(report(sample_domain +
                   "[[foam.bubble]]\nshape = \"sphere\"\ncenter = [0.002, 0, 0]\nradius = 0.0015\n"),
            "wrong.toml:5:1: bubble 1 reaches from 0.0005 to 0.0035 m along x; it must stay 4 cells inside "
            "the box, "
            "between -0.003 and 0.003 m");
}

TEST(WrongCase, bubble_lacks_or_has_what_does_not_go_with_its_shape) {
  EXPECT_THAT(report(sample_domain + "[[foam.bubble]]\nradius = 0.001\n"),
              AllOf(HasSubstr("bubble 1 has no 'shape'"), HasSubstr("bubble 1 has no 'center'")));
  EXPECT_THAT(
      report(sample_domain + "[[foam.bubble]]\nshape = \"ellipsoid\"\ncenter = [0, 0, 0]\nradius = 0.001\n"),
      AllOf(HasSubstr("bubble 1, an ellipsoid, has no 'semi_axes'"), HasSubstr("no 'radius'")));
  EXPECT_THAT(report(sample_case + "colour = 3\n"), HasSubstr("unknown key 'foam.bubble.colour'"));
  EXPECT_THAT(
      report(sample_domain + "[[foam.bubble]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = -0.001\n"),
      HasSubstr("wrong.toml:8:10: bubble 1: 'foam.bubble.radius' must be a number > 0, not -0.001"));
}

TEST(WrongCase, case_without_bubbles_is_refused) {
  EXPECT_THAT(report(sample_domain), HasSubstr("no bubbles"));
}

TEST(WrongCase, lattice_needs_a_periodic_box_that_it_fits) {
  const std::string kelvin = sample_domain + "[foam.lattice]\nstructure = \"kelvin\"\ncells = 2\n";
  EXPECT_EQ(report(kelvin), "");
  EXPECT_THAT(report(kelvin, {R"(domain.boundary=["periodic", "periodic", "slip"])"}),
              HasSubstr("[foam.lattice] needs a box that is periodic in all three directions"));
  EXPECT_THAT(report(kelvin, {"foam.lattice.cells=1"}), HasSubstr("every bubble would touch its own image"));
  EXPECT_EQ(report(kelvin, {"foam.lattice.cells=1", "foam.lattice.structure=weaire-phelan"}), "");
  EXPECT_THAT(report(kelvin, {"domain.upper=[0.004, 0.004, 0.008]", "domain.cells=[32, 32, 48]"}), "");
  EXPECT_THAT(report(kelvin, {"domain.upper=[0.004, 0.004, 0.005]", "domain.cells=[32, 32, 36]"}),
              HasSubstr("the crystal does not fit the box: 2.25 cubic cells along z"));
  EXPECT_THAT(report(kelvin, {"foam.lattice.cells=9"}),
              HasSubstr("1458 bubbles are too many for this grid: each fills a cube of 2.8 cells edge"));
  EXPECT_THAT(report(kelvin, {"foam.lattice.count=12"}),
              HasSubstr("'foam.lattice.count' has no effect here: it belongs to structure = \"random\""));
  EXPECT_THAT(report(kelvin, {"foam.lattice.structure=random", "foam.lattice.cells=3"}),
              HasSubstr("'foam.lattice.cells' has no effect here"));
  EXPECT_THAT(report(kelvin + sample_bubble), HasSubstr("wrong.toml:5:2: [foam.lattice] fills the box"));
  EXPECT_THAT(report(kelvin, {"foam.remove_lamella=[[1, 17]]"}),
              HasSubstr("the phases are 0 (outside) to 16"));
}

TEST(WrongCase, membrane_must_close_on_itself) {
  const std::string text = sample_case + "[foam.membrane]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";
  const std::string sides = R"(domain.boundary=["periodic", "periodic", "wall"])";
  EXPECT_EQ(report(text, {sides}), "");
  EXPECT_THAT(report(text),
              HasSubstr("[foam.membrane] lies across z: there the box needs \"wall\" or \"slip\""));
  EXPECT_THAT(report(text, {R"(domain.boundary=["wall", "periodic", "wall"])"}),
              HasSubstr("[foam.membrane] would meet a wall across x, which is not supported"));
  EXPECT_THAT(report(text, {sides, "foam.membrane.normal=[0, 1, 1]"}), HasSubstr("must be along x, y or z"));
  EXPECT_THAT(report(text, {sides, "foam.membrane.normal=[0, 0, 0]"}), HasSubstr("must be along x, y or z"));
  EXPECT_THAT(report(text, {sides, "foam.membrane.point=[0, 0, 0.0035]"}),
              HasSubstr("it must stay 4 cells inside the box"));
  EXPECT_THAT(report(text, {sides, "gravity=[1, 0, 0]"}), HasSubstr("'gravity' along x"));
}

TEST(WrongCase, labels_need_a_file_and_stand_alone) {
  EXPECT_THAT(report(sample_domain + "[foam.labels]\n"), HasSubstr("[foam.labels] has no 'file'"));
  EXPECT_THAT(report(sample_case + "[foam.labels]\nfile = \"a.vti\"\n"),
              HasSubstr("[foam.labels] gives the whole foam"));
}

TEST(WrongCase, films_of_a_file_stand_alone_and_only_drain) {
  const std::string films = "[foam.films]\nfile = \"a.vtp\"\n", drain = "[cycle]\nstages = [\"drain\"]\n";
  EXPECT_EQ(report(films + drain), "");  // without a [domain]
  EXPECT_THAT(report("[foam.films]\n" + drain), HasSubstr("[foam.films] has no 'file'"));
  EXPECT_THAT(report(films), HasSubstr("'cycle.stages' must be [\"drain\"]"));
  EXPECT_THAT(report(sample_case + films + drain), HasSubstr("[foam.films] gives all films"));
  EXPECT_THAT(report(films + drain, {"foam.equilibrate=true"}), HasSubstr("drained as they are"));
  EXPECT_THAT(report(films + drain, {"domain.boundary=[\"wall\", \"periodic\", \"wall\"]"}),
              HasSubstr("do not go on through periodic faces"));
}

TEST(WrongCase, edges_of_the_drainage_mesh_are_of_the_size_of_a_cell) {
  EXPECT_EQ(report(sample_case, {"drainage.edge_at_borders=2.5e-4", "drainage.edge_at_junctions=5.1e-6"}),
            "");
  EXPECT_EQ(report(sample_case, {"drainage.edge_at_junctions=3e-5"}), "");  // borders by the grid
  for (const std::string key : {"drainage.edge_at_borders", "drainage.edge_at_junctions"})
    for (const std::string edge : {"4.9e-06", "0.000251", "1e-300"})
      EXPECT_EQ(
          report(sample_case, {key + "=" + edge}),
          "--set " + key + "=" + edge + ": '" + key +
              "' must be 0 or from 5e-06 to 0.00025 m, 1/50 of a cell of the grid to a whole one, not " +
              edge);
  EXPECT_THAT(
      report(sample_case, {"drainage.edge_at_borders=2e-5", "drainage.edge_at_junctions=3e-5"}),
      HasSubstr("'drainage.edge_at_junctions' must be ≤ 'drainage.edge_at_borders', 2e-05 m, not 3e-05"));
  const std::string films = "[foam.films]\nfile = \"a.vtp\"\n[cycle]\nstages = [\"drain\"]\n";
  EXPECT_THAT(report(films, {"drainage.edge_at_junctions=0.1"}), HasSubstr("films of a file are not meshed"));
  EXPECT_EQ(report(films, {"drainage.edge_at_borders=0"}), "");
}

TEST(WrongCase, pair_of_phases_that_does_not_exist_is_refused) {
  EXPECT_THAT(report(sample_case, {"foam.remove_lamella=[[1, 2]]"}), HasSubstr("there is no phase 2"));
  EXPECT_THAT(report(sample_case, {"rupture.protect=[[1, 1]]"}), HasSubstr("between phase 1 and itself"));
}

TEST(WrongCase, bad_option_is_named_as_it_was_typed) {
  EXPECT_EQ(report(sample_case, {"cycle.endtime=3"}),
            "--set cycle.endtime=3: unknown key 'cycle.endtime'; did you mean 'cycle.end_time'?");
  EXPECT_THAT(report(sample_case, {"cycle.end_time"}),
              HasSubstr("--set cycle.end_time: an option has the form"));
  EXPECT_THAT(report(sample_case, {"cycle.end_time="}), HasSubstr("no value"));
  EXPECT_THAT(report(sample_case, {"cycle.end_time=[1"}), testing::StartsWith("--set cycle.end_time=[1: "));
}

TEST(ReadText, file_that_cannot_be_read_is_named) {
  EXPECT_THROW(read_text("/nonexistent/case.toml"), InputError);
  EXPECT_THROW(read_text("/"), InputError);
}

}  // namespace
}  // namespace spume::config
