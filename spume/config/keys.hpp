#pragma once

#include <string>
#include <vector>

#include "spume/config/key.hpp"
#include "spume/simulation/case.hpp"

namespace spume::config {

/// A section of the case file.
struct Section {
  std::string name;  ///< "foam.cluster"; empty for the top level
  std::string meaning;
  /// For sections that a case may lack: whether it has it, and how it gets it with its defaults.
  bool (*is_present)(const simulation::Case&) = nullptr;
  void (*create)(simulation::Case&) = nullptr;
};

/// One [[foam.bubble]] as the user writes it.
struct BubbleEntry {
  enum class Shape { Sphere, Ellipsoid } shape = Shape::Sphere;
  Vec3 center;        ///< [m]
  double radius = 0;  ///< [m], of a sphere
  Vec3 semi_axes;     ///< [m], of an ellipsoid
};

// The one table of keys: reading, checking, `spume describe` and the resolved case all come from it.
const std::vector<Section>& sections();
const std::vector<Key<simulation::Case>>&
case_keys();  ///< all keys but those of [[foam.bubble]], in order of sections
const std::vector<Key<BubbleEntry>>& bubble_keys();  ///< keys of each [[foam.bubble]]

/// The name of the list of bubbles, an array of tables.
inline const std::string bubble_list = "foam.bubble";

}  // namespace spume::config
