#pragma once

#include <string_view>

namespace spume::io {

/// A column of a table or an array of a picture file, and what it means. Writers and the explanation of the
/// files for the user read the same list, so that they cannot disagree.
struct Column {
  std::string_view name;
  std::string_view meaning;
};

}  // namespace spume::io
