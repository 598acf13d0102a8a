#include "spume/config/write_case.hpp"

#include "spume/config/keys.hpp"
#include "spume/config/value_text.hpp"
#include "spume/config/version.hpp"

namespace spume::config {

namespace {

using simulation::Case;

std::string line_of(const std::string& name, const std::string& value, const std::string& unit) {
  return leaf_of(name) + " = " + value + (unit.empty() ? "" : "   # " + unit) + "\n";
}

std::string bubble_text(const simulation::BubbleShape& shape) {
  const Vec3& axes = shape.semi_axes;
  const bool sphere = axes.x == axes.y && axes.y == axes.z;
  BubbleEntry bubble{.shape = sphere ? BubbleEntry::Shape::Sphere : BubbleEntry::Shape::Ellipsoid,
                     .center = shape.center,
                     .radius = axes.x,
                     .semi_axes = axes};
  const std::string unused = sphere ? "foam.bubble.semi_axes" : "foam.bubble.radius";
  std::string text = "\n[[" + bubble_list + "]]\n";
  for (const auto& key : bubble_keys())
    if (key.name != unused) text += line_of(key.name, value_text(key.kind, bubble), key.unit);
  return text;
}

std::string section_text(const Section& section, Case& run_case) {
  std::string text;
  if (!section.name.empty()) text += "\n[" + section.name + "]\n";
  for (const auto& key : case_keys()) {
    if (section_of(key.name) != section.name) continue;
    const std::string value = value_text(key.kind, run_case);
    if (!value.empty()) text += line_of(key.name, value, key.unit);
  }
  return text;
}

}  // namespace

std::string write_case(const Case& run_case) {
  Case writable = run_case;  // the members of the table are found in a Case that could be written to
  std::string text = "# spume " + version() + ": every key of the case, with its value\n";
  for (const auto& section : sections())
    if (section.is_present == nullptr || section.is_present(run_case))
      text += section_text(section, writable);
  for (const auto& bubble : run_case.foam.bubble) text += bubble_text(bubble);
  return text;
}

}  // namespace spume::config
