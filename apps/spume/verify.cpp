#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "apps/spume/commands.hpp"
#include "spume/base/error.hpp"
#include "spume/config/nearest.hpp"
#include "spume/config/text.hpp"
#include "spume/verification/study.hpp"

namespace spume::app {

namespace {

struct Request {
  std::vector<std::string> names;
  bool list = false, small = false;
};

/// The studies asked for, in their order; all when none is named.
std::vector<const verification::Study*> chosen(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const auto& study : verification::studies()) known.push_back(study.name);
  for (const auto& name : names)
    if (std::ranges::find(known, name) == known.end())
      throw InputError("no study has the name '" + name + "'" +
                       config::did_you_mean(config::nearest_names(name, known)) +
                       "\nspume verify --list names all studies");
  std::vector<const verification::Study*> studies;
  for (const auto& study : verification::studies())
    if (names.empty() || std::ranges::find(names, study.name) != names.end()) studies.push_back(&study);
  return studies;
}

std::string list_text() {
  std::vector<std::vector<std::string>> rows;
  for (const auto& study : verification::studies())
    rows.push_back({study.name, fmt::format("{:.0f} s", study.seconds),
                    fmt::format("({:.0f} s --small)", study.small_seconds), study.summary, study.source});
  return config::aligned(rows);
}

void verify(const parallel::Communicator& communicator, const Request& request) {
  const auto studies = chosen(request.names);
  if (request.list) {
    communicator.on_root([] { std::fputs(list_text().c_str(), stdout); });
    return;
  }
  verification::Report report(communicator);
  for (const auto* study : studies)
    verification::run(*study, communicator,
                      request.small ? verification::Scale::Small : verification::Scale::Full, report);
  if (report.n_outside() > 0)
    throw FailedCheck(
        fmt::format("{} of {} values are outside their bands", report.n_outside(), report.n_judged()));
  communicator.on_root([&] { std::printf("all %d values are within their bands\n", report.n_judged()); });
}

}  // namespace

void add_verify(CLI::App& program, const parallel::Communicator& communicator) {
  const auto request = std::make_shared<Request>();
  CLI::App* command = program.add_subcommand(
      "verify", "compare with exact solutions and published numbers; exit code 1 if one is outside its band");
  command->add_option("NAME", request->names, "studies; all of them when none is given");
  command->add_flag("--list", request->list, "name the studies, with their meaning and duration on one core");
  command->add_flag("--small", request->small, "coarser and quicker variants, with wider bands");
  command->callback([request, communicator] { verify(communicator, *request); });
}

}  // namespace spume::app
