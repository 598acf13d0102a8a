#include "spume/parallel/communicator.hpp"

#include <cstdlib>
#include <limits>
#include <vector>

#include "spume/base/contract.hpp"

namespace spume::parallel {

namespace {

int message_count(std::size_t n) {
  expects(n <= static_cast<std::size_t>(std::numeric_limits<int>::max()), "an MPI message fits an int count");
  return static_cast<int>(n);
}

double all_reduce(double value, MPI_Op operation, MPI_Comm comm) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, operation, comm);
  return value;
}

}  // namespace

Communicator::Communicator(MPI_Comm comm) : comm_(comm), rank_(0), size_(1) {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

double Communicator::sum(double value) const {
  sum(std::span(&value, 1));
  return value;
}

double Communicator::max(double value) const {
  return all_reduce(value, MPI_MAX, comm_);
}

double Communicator::min(double value) const {
  return all_reduce(value, MPI_MIN, comm_);
}

bool Communicator::any(bool value) const {
  return max(value ? 1.0 : 0.0) > 0;
}

void Communicator::sum(std::span<double> values) const {
  if (size_ == 1) return;
  // MPI does not promise that MPI_Allreduce gives every rank the same last bit; one reducer and a broadcast
  // do.
  const int n = message_count(values.size());
  MPI_Reduce(is_root() ? MPI_IN_PLACE : values.data(), values.data(), n, MPI_DOUBLE, MPI_SUM, 0, comm_);
  MPI_Bcast(values.data(), n, MPI_DOUBLE, 0, comm_);
}

void Communicator::expect_offsets(std::size_t n_values, std::span<const int> offset) const {
  expects(offset.size() == static_cast<std::size_t>(size_) + 1 && offset.front() == 0 &&
              n_values == static_cast<std::size_t>(offset.back()),
          "an offset for each rank and the end of the array");
}

std::vector<int> Communicator::shares(int n) const {
  std::vector<int> offset(size_ + 1);
  for (int rank = 0; rank <= size_; ++rank)
    offset[rank] = static_cast<int>(static_cast<long>(n) * rank / size_);
  return offset;
}

void Communicator::broadcast(std::span<double> values, int root) const {
  MPI_Bcast(values.data(), message_count(values.size()), MPI_DOUBLE, root, comm_);
}

void Communicator::broadcast(std::string& text, int root) const {
  int length = message_count(text.size());
  MPI_Bcast(&length, 1, MPI_INT, root, comm_);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, root, comm_);
}

void Communicator::abort(int exit_code) const {
  MPI_Abort(comm_, exit_code);
  std::abort();
}

void Communicator::barrier() const {
  MPI_Barrier(comm_);
}

void Communicator::rethrow_together(Failure failure, std::string message) const {
  int first = failure == Failure::None ? size_ : rank_;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm_);
  if (first == size_) return;
  int kind = static_cast<int>(failure);
  MPI_Bcast(&kind, 1, MPI_INT, first, comm_);
  broadcast(message, first);
  switch (static_cast<Failure>(kind)) {
    case Failure::Input:
      throw InputError(message);
    case Failure::Numerical:
      throw NumericalError(message);
    case Failure::Interruption:
      throw Interrupted(message);
    case Failure::None:
    case Failure::Other:
      throw std::runtime_error(message);
  }
}

}  // namespace spume::parallel
