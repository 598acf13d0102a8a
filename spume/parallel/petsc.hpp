#pragma once

#include <petscsys.h>

#include <source_location>
#include <utility>

namespace spume::parallel {

/// Throws NumericalError with PETSc's own message and the place of the call when `code` is an error.
/// For .cpp files and internal headers only: it brings PETSc's headers.
void petsc_check(PetscErrorCode code, const std::source_location& where = std::source_location::current());

/// Owner of one PETSc object; a moved-from or fresh one holds nothing.
/// `PetscOwner<Mat, MatDestroy> a; petsc_check(MatCreate(comm, a.out()));`
template <class Object, PetscErrorCode (*destroy)(Object*)>
class PetscOwner {
 public:
  PetscOwner() = default;
  ~PetscOwner() { release(); }
  PetscOwner(PetscOwner&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  PetscOwner& operator=(PetscOwner&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }

  Object get() const { return object_; }
  /// Where a PETSc create function writes the new object; destroys the one held.
  Object* out() {
    release();
    return &object_;
  }

 private:
  // A destructor has nobody to tell of a failure.
  void release() noexcept { static_cast<void>(destroy(&object_)); }

  Object object_ = nullptr;
};

}  // namespace spume::parallel
