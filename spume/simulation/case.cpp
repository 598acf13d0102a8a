#include "spume/simulation/case.hpp"

namespace spume::simulation {

const char* name(Stage stage) {
  switch (stage) {
    case Stage::Rearrange:
      return "rearrange";
    case Stage::Drain:
      return "drain";
    case Stage::Rupture:
      return "rupture";
  }
  return "";
}

}  // namespace spume::simulation
