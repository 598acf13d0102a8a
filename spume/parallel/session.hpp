#pragma once

namespace spume::parallel {

/// Starts MPI, FFTW-MPI and PETSc for the life of `main` and ends them on every way out.
/// PETSc's own signal handler is switched off: signals belong to the program. PETSc reads no options from the
/// command line or from files, and its errors become exceptions (petsc.hpp) in place of printed traces. An
/// MPI that runs already is used and left running. Throws std::runtime_error when something cannot be
/// started.
class Session {
 public:
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  bool started_mpi_ = false;
};

}  // namespace spume::parallel
