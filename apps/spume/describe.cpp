#include "spume/config/describe.hpp"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <memory>

#include "apps/spume/commands.hpp"

namespace spume::app {

void add_describe(CLI::App& program, const parallel::Communicator& communicator) {
  const auto section = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand(
      "describe", "every key of a case file: meaning, unit, default, range, symbol in the paper");
  command->add_option("SECTION", *section, "one section, as in drainage; all when not given");
  command->callback([section, communicator] {
    communicator.on_root([&] { std::fputs(config::describe(*section).c_str(), stdout); });
  });
}

}  // namespace spume::app
