#include "spume/config/assess.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "sample_case.hpp"
#include "spume/config/read_case.hpp"

namespace spume::config {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

Assessment assessment_of(const std::vector<std::string>& options) {
  const auto run_case = parse_case(sample_case, "sample.toml", options);
  return assess(run_case, run_case.foam.bubble);
}

TEST(Assess, gives_the_numbers_of_a_bubble) {
  const Assessment a = assessment_of({});
  EXPECT_DOUBLE_EQ(a.h, 0.25e-3);
  EXPECT_DOUBLE_EQ(a.smallest_diameter, 3e-3);
  EXPECT_NEAR(a.laplace_number, 2 * 0.03 * 1.2 * 3e-3 / (1.8e-5 * 1.8e-5), 1e-9 * a.laplace_number);
  EXPECT_NEAR(a.step_limits.front().dt, 0.8 * std::sqrt(1.2 * std::pow(0.25e-3, 3) / 0.06), 1e-12);
  EXPECT_NEAR(a.border_radius, std::sqrt(1e-9 / 0.1612545), 1e-6 * a.border_radius) << "√3 − π/2 = 0.1612545";
  // A sphere has 2η A / V = 6η/r of liquid; its area is counted to 2 % on 12 cells across.
  EXPECT_NEAR(a.liquid_fraction, 6 * 5e-6 / 1.5e-3, 0.04 * a.liquid_fraction);
  EXPECT_THAT(a.warnings, IsEmpty());
}

TEST(Assess, warns_of_a_wet_foam) {
  EXPECT_THAT(assessment_of({"foam.lamella_half_thickness=3e-5"}).warnings,
              Contains(HasSubstr("liquid fraction")));
}

TEST(Assess, warns_of_borders_as_thick_as_bubbles) {
  EXPECT_THAT(assessment_of({"foam.border_area=2e-8"}).warnings, Contains(HasSubstr("Plateau borders")));
}

TEST(Assess, warns_of_a_coarse_grid) {
  EXPECT_THAT(assessment_of({"domain.cells=[20, 20, 20]"}).warnings, Contains(HasSubstr("7.5 cells across")));
}

TEST(Assess, warns_of_films_that_break_at_once) {
  EXPECT_THAT(assessment_of({"rupture.threshold=1e-5"}).warnings, Contains(HasSubstr("break at once")));
}

TEST(Assess, warns_of_an_interface_method_that_is_not_used) {
  EXPECT_THAT(assessment_of({"rearrangement.interface=viim"}).warnings, IsEmpty());
  EXPECT_THAT(assessment_of({"rearrangement.interface=viim", "rearrangement.dynamics=quasistatic"}).warnings,
              Contains(HasSubstr("no effect")));
}

TEST(Assess, knows_that_a_reconstruction_at_every_step_costs_more) {
  EXPECT_GT(assessment_of({"rearrangement.interface=viim"}).seconds_per_step,
            3 * assessment_of({}).seconds_per_step);
}

TEST(Report, shows_step_limits_with_reasons_and_warnings_last) {
  const auto run_case = parse_case(sample_case, "sample.toml", {"domain.cells=[20, 20, 20]"});
  const std::string text = report(assess(run_case, run_case.foam.bubble), run_case);
  EXPECT_THAT(text, HasSubstr("20 × 20 × 20 cells of h = 0.0004 m"));
  EXPECT_THAT(text, HasSubstr("capillary waves"));
  EXPECT_THAT(text, HasSubstr("advection"));
  EXPECT_GT(text.find("warning: "), text.find("memory"));
}

}  // namespace
}  // namespace spume::config
