#include "spume/config/version.hpp"

namespace spume::config {

std::string version() {
  return SPUME_VERSION;
}

}  // namespace spume::config
