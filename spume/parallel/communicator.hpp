#pragma once

#include <mpi.h>

#include <span>
#include <string>
#include <vector>

namespace spume::parallel {

/// The ranks that share one simulation. A light handle; copies refer to the same ranks.
/// Every member function that is not a mere question about this rank (rank, size, is_root, handle, shares) is
/// Collective.
class Communicator {
 public:
  static Communicator world() { return Communicator(MPI_COMM_WORLD); }
  /// This rank alone.
  static Communicator self() { return Communicator(MPI_COMM_SELF); }
  explicit Communicator(MPI_Comm comm);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  MPI_Comm handle() const { return comm_; }

  /// The results of these reductions are bitwise the same on every rank.
  double sum(double value) const;
  double max(double value) const;
  double min(double value) const;
  bool any(bool value) const;
  /// Element-wise sum in place. Where all ranks but one hold zero, the result is exact.
  void sum(std::span<double> values) const;

  /// Gives every rank the whole of an array of which each has filled its part, values[offset[rank] …
  /// offset[rank + 1]), which may be empty; `offset` is the same on every rank, with size() + 1 entries. T is
  /// sent byte by byte.
  template <class T>
  void all_gather(std::span<T> values, std::span<const int> offset) const;
  /// The parts of all ranks one after another; `offset` gets where each begins, and the end. T is trivially
  /// copyable.
  template <class T>
  std::vector<T> joined(std::vector<T> part, std::vector<int>& offset) const;
  /// Offsets of even shares of n items.
  std::vector<int> shares(int n) const;
  void broadcast(std::span<double> values, int root = 0) const;
  void broadcast(std::string& text, int root = 0) const;
  void barrier() const;
  /// Ends the program on every rank at once, for failures that one rank alone has met: the others may be
  /// waiting for it.
  [[noreturn]] void abort(int exit_code) const;

  /// Runs `work` on rank 0 only; an exception there is thrown on every rank with the same type and message
  /// (InputError, NumericalError, Interrupted, or std::runtime_error for every other), so that all ranks fail
  /// together.
  template <class Work>
  void on_root(Work&& work) const;
  /// Runs `work` on every rank; a failure of one becomes a failure of all, with the type and message of the
  /// lowest rank that failed. A rank must not fail between collective calls inside `work`: the others would
  /// wait for it for ever.
  template <class Work>
  void together(Work&& work) const;

 private:
  enum class Failure { None, Input, Numerical, Interruption, Other };
  void expect_offsets(std::size_t n_values, std::span<const int> offset) const;
  void rethrow_together(Failure failure, std::string message) const;

  MPI_Comm comm_;
  int rank_, size_;
};

}  // namespace spume::parallel

#include "spume/parallel/communicator_gather.hpp"
#include "spume/parallel/communicator_together.hpp"
