#include "apps/spume/output_folder.hpp"

#include <unistd.h>

#include "spume/base/error.hpp"

namespace spume::app {

namespace fs = std::filesystem;

fs::path default_output_folder(const fs::path& case_file) {
  const std::string stem = case_file.stem().string();
  if (stem == fs::path(resolved_case_name).stem())
    return fs::weakly_canonical(case_file).parent_path().filename().string() + "-run";
  const std::string parent = case_file.parent_path().filename().string();
  const bool parent_has_name = !parent.empty() && parent != "." && parent != "..";
  return (parent_has_name ? parent + "-" : "") + stem + "-run";
}

void check_output_folder(const fs::path& folder, const fs::path& case_file) {
  std::error_code error;
  fs::path nearest = fs::absolute(folder).lexically_normal();
  while (!fs::exists(nearest, error) && nearest.has_parent_path() && nearest != nearest.parent_path())
    nearest = nearest.parent_path();
  if (!fs::is_directory(nearest, error))
    throw InputError(folder.string() + ": no output can be written there, because " + nearest.string() +
                     " is a file");
  if (::access(nearest.c_str(), W_OK | X_OK) != 0)
    throw InputError(folder.string() + ": no output can be written there: " +
                     std::generic_category().message(errno) + " (" + nearest.string() + ")");
  if (fs::equivalent(folder / resolved_case_name, case_file, error))
    throw InputError(folder.string() + ": holds the case file itself; give another folder with -o");
}

bool holds_run(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / resolved_case_name, error);
}

}  // namespace spume::app
