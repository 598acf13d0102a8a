#pragma once

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "spume/parallel/communicator.hpp"

namespace spume::parallel {

/// Memory of the ranks of one machine that each of them may read and write: a part a rank.
class SharedMemory {
 public:
  /// n numbers, zero, for this rank, on 64 bytes; n may differ from rank to rank. Nothing where the ranks are
  /// spread over several machines, or where the machine keeps too little room for memory that programs share,
  /// as some containers do. Collective, as the end of the object is, unless an exception brings that about:
  /// then the memory stays until the program ends.
  static std::unique_ptr<SharedMemory> among(const Communicator& ranks, std::size_t n);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  double* part(int rank) const { return part_[rank]; }
  /// Waits for all ranks; every one then sees what the others wrote before. Collective.
  void synchronise() const;

 private:
  SharedMemory(const Communicator& ranks, std::size_t n);

  Communicator ranks_;
  MPI_Win window_;
  std::vector<double*> part_;
};

}  // namespace spume::parallel
