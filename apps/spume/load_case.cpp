#include "apps/spume/load_case.hpp"

#include "spume/base/error.hpp"
#include "spume/config/read_case.hpp"
#include "spume/simulation/start.hpp"

namespace spume::app {

LoadedCase load_case(const parallel::Communicator& communicator, const std::filesystem::path& file,
                     const std::vector<std::string>& options) {
  std::string text;
  communicator.on_root([&] { text = config::read_text(file); });
  communicator.broadcast(text);
  LoadedCase loaded;
  communicator.together([&] {
    loaded.run_case = config::parse_case(text, file.string(), options);
    try {
      loaded.bubbles = simulation::bubbles_of(loaded.run_case);
    } catch (const InputError& error) {
      throw InputError(file.string() + ": " + error.what());
    }
  });
  return loaded;
}

}  // namespace spume::app
