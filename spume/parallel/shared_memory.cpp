#include "spume/parallel/shared_memory.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <system_error>

namespace spume::parallel {

namespace {

bool on_one_machine(const Communicator& ranks) {
  MPI_Comm machine;
  MPI_Comm_split_type(ranks.handle(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const bool all = Communicator(machine).size() == ranks.size();
  MPI_Comm_free(&machine);
  return !ranks.any(!all);
}

/// On Linux, MPI keeps shared memory in this folder; writing to more than it holds would end the program.
/// Half of it is left to others.
bool has_room(double n_bytes) {
  std::error_code missing;
  const auto space = std::filesystem::space("/dev/shm", missing);
  return !missing && static_cast<double>(space.available) > 2 * n_bytes;
}

constexpr std::size_t line = 64;  // of the cache [bytes]

/// MPI promises no alignment. Every rank sees the memory at the same place of a page, so all find the same
/// line.
double* next_line(void* memory) {
  std::size_t room = 2 * line;
  return static_cast<double*>(std::align(line, line, memory, room));
}

}  // namespace

std::unique_ptr<SharedMemory> SharedMemory::among(const Communicator& ranks, std::size_t n) {
  const double n_bytes = ranks.sum(static_cast<double>(n * sizeof(double)));
  if (!on_one_machine(ranks) || ranks.any(!has_room(n_bytes))) return nullptr;
  return std::unique_ptr<SharedMemory>(new SharedMemory(ranks, n));
}

SharedMemory::SharedMemory(const Communicator& ranks, std::size_t n) : ranks_(ranks), part_(ranks.size()) {
  MPI_Info apart;  // each part on pages of its own, near to its rank
  MPI_Info_create(&apart);
  MPI_Info_set(apart, "alloc_shared_noncontig", "true");
  void* memory = nullptr;
  MPI_Win_allocate_shared(static_cast<MPI_Aint>(n * sizeof(double) + line), sizeof(double), apart,
                          ranks_.handle(), &memory, &window_);
  MPI_Info_free(&apart);
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    MPI_Aint size;
    int unit;
    MPI_Win_shared_query(window_, rank, &size, &unit, &memory);
    part_[rank] = next_line(memory);
  }
  MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
  std::fill_n(part_[ranks_.rank()], n, 0.0);
  synchronise();
}

SharedMemory::~SharedMemory() {
  // A rank that fails alone must come to where it ends the others, who do not come here and would be waited
  // for. What is left is the system's when the program ends.
  if (std::uncaught_exceptions() > 0) return;
  MPI_Win_unlock_all(window_);
  MPI_Win_free(&window_);
}

void SharedMemory::synchronise() const {
  MPI_Win_sync(window_);
  ranks_.barrier();
  MPI_Win_sync(window_);
}

}  // namespace spume::parallel
