#pragma once

#include <string>
#include <vector>

namespace spume::config {

/// Where something stands: a place in the case file, or an option of the command line (line 0).
struct Place {
  std::string source;  ///< name of the file, or the option as typed
  int line = 0, column = 0;

  /// "case.toml:12:3", or the source alone.
  std::string text() const;
};

/// All that is wrong with a case, to be told in one report.
class Problems {
 public:
  void add(const Place& place, const std::string& what) { list_.push_back({place, what}); }
  bool none() const { return list_.empty(); }

  /// Throws InputError with one line per problem, in the order of the file, when there is any.
  void throw_if_any() const;

 private:
  struct Problem {
    Place place;
    std::string what;
  };
  std::vector<Problem> list_;
};

}  // namespace spume::config
