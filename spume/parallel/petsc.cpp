#include "spume/parallel/petsc.hpp"

#include <string>

#include "spume/base/error.hpp"

namespace spume::parallel {

void petsc_check(PetscErrorCode code, const std::source_location& where) {
  if (code == 0) return;
  const char* kind = nullptr;
  char* specific = nullptr;
  static_cast<void>(PetscErrorMessage(code, &kind, &specific));
  std::string message = "PETSc error " + std::to_string(static_cast<int>(code));
  if (kind != nullptr) message += std::string(" (") + kind + ")";
  if (specific != nullptr && *specific != '\0') message += std::string(": ") + specific;
  message += std::string(", called from ") + where.function_name();
  throw NumericalError(message);
}

}  // namespace spume::parallel
