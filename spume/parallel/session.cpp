#include "spume/parallel/session.hpp"

#include <fftw3-mpi.h>
#include <mpi.h>
#include <petscsys.h>

#include "spume/parallel/petsc.hpp"

namespace spume::parallel {

Session::Session(int& argc, char**& argv) {
  int mpi_runs = 0;
  MPI_Initialized(&mpi_runs);
  if (mpi_runs == 0) {
    MPI_Init(&argc, &argv);
    started_mpi_ = true;
  }
  fftw_mpi_init();
  // Options may be set before PETSc is initialised; these two act during its initialisation.
  petsc_check(PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr));
  petsc_check(PetscOptionsSetValue(nullptr, "-skip_petscrc", nullptr));
  petsc_check(PetscInitializeNoArguments());
  petsc_check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

Session::~Session() {
  static_cast<void>(PetscPopErrorHandler());
  static_cast<void>(PetscFinalize());
  fftw_mpi_cleanup();
  if (started_mpi_) MPI_Finalize();
}

}  // namespace spume::parallel
