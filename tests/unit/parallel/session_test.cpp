#include "spume/parallel/session.hpp"

#include <gtest/gtest.h>
#include <petscvec.h>

#include <string>

#include "spume/base/error.hpp"
#include "spume/parallel/petsc.hpp"

namespace {

TEST(Session, HasStartedMpiAndPetsc) {
  int mpi_runs = 0;
  MPI_Initialized(&mpi_runs);
  EXPECT_EQ(mpi_runs, 1);
  PetscBool petsc_runs = PETSC_FALSE;
  spume::parallel::petsc_check(PetscInitialized(&petsc_runs));
  EXPECT_EQ(petsc_runs, PETSC_TRUE);
}

TEST(PetscCheck, TurnsPetscErrorsIntoExceptionsThatKeepTheMessage) {
  spume::parallel::PetscOwner<Vec, VecDestroy> vector;
  spume::parallel::petsc_check(VecCreateSeq(PETSC_COMM_SELF, 4, vector.out()));
  std::string message;
  try {
    spume::parallel::petsc_check(VecSetType(vector.get(), "no such type"));
  } catch (const spume::NumericalError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("no such type"), std::string::npos) << message;
}

TEST(PetscOwner, MovesAndDestroysItsObject) {
  using Owner = spume::parallel::PetscOwner<Vec, VecDestroy>;
  Owner first;
  spume::parallel::petsc_check(VecCreateSeq(PETSC_COMM_SELF, 4, first.out()));
  const Vec object = first.get();
  // A second reference keeps the object alive, so that its count can be read after the owner's end.
  spume::parallel::petsc_check(PetscObjectReference(reinterpret_cast<PetscObject>(object)));
  PetscInt references = 0;
  {
    const Owner second = std::move(first);
    EXPECT_EQ(second.get(), object);
    EXPECT_EQ(first.get(), nullptr);
    spume::parallel::petsc_check(PetscObjectGetReference(reinterpret_cast<PetscObject>(object), &references));
    EXPECT_EQ(references, 2);
  }
  spume::parallel::petsc_check(PetscObjectGetReference(reinterpret_cast<PetscObject>(object), &references));
  EXPECT_EQ(references, 1);
  Vec last = object;
  spume::parallel::petsc_check(VecDestroy(&last));
}

}  // namespace
