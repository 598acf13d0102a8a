#include "spume/base/contract.hpp"

#include <stdexcept>
#include <string>

namespace spume {

void contract_violation(const char* what, const std::source_location& where) {
  throw std::logic_error(std::string("broken contract in ") + where.function_name() + " (" +
                         where.file_name() + ":" + std::to_string(where.line()) + "): " + what);
}

}  // namespace spume
