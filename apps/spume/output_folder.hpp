#pragma once

#include <filesystem>

namespace spume::app {

/// The folder for the output of a case when the user names none, in the folder the program runs in:
/// cases/fig15/case.toml gives fig15-run, cases/fig15/small.toml gives fig15-small-run, foam.toml gives
/// foam-run.
std::filesystem::path default_output_folder(const std::filesystem::path& case_file);

/// Throws InputError when nothing could be written into `folder`, which may not exist yet, or when it is the
/// folder of the case file itself under the name that a run would overwrite. Makes and changes nothing.
void check_output_folder(const std::filesystem::path& folder, const std::filesystem::path& case_file);

/// Whether `folder` holds a run.
bool holds_run(const std::filesystem::path& folder);

/// Name of the resolved case in an output folder.
inline constexpr const char* resolved_case_name = "case.toml";

}  // namespace spume::app
