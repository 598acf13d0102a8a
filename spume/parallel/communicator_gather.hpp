#pragma once

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "spume/parallel/communicator.hpp"

namespace spume::parallel {

/// An MPI datatype of the bytes of a T.
template <class T>
class ByteType {
 public:
  static_assert(std::is_trivially_copyable_v<T>, "values are sent byte by byte");
  ByteType() {
    MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~ByteType() { MPI_Type_free(&type_); }
  ByteType(const ByteType&) = delete;
  ByteType& operator=(const ByteType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_;
};

template <class T>
void Communicator::all_gather(std::span<T> values, std::span<const int> offset) const {
  expect_offsets(values.size(), offset);
  if (size_ == 1) return;
  std::vector<int> count(size_);
  for (int rank = 0; rank < size_; ++rank) count[rank] = offset[rank + 1] - offset[rank];
  const ByteType<T> type;
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values.data(), count.data(), offset.data(), type, comm_);
}

template <class T>
std::vector<T> Communicator::joined(std::vector<T> part, std::vector<int>& offset) const {
  const int n = static_cast<int>(part.size());
  offset.assign(size_ + 1, 0);
  MPI_Allgather(&n, 1, MPI_INT, offset.data() + 1, 1, MPI_INT, comm_);
  for (int rank = 0; rank < size_; ++rank) offset[rank + 1] += offset[rank];
  if (size_ == 1) return part;
  std::vector<T> whole(offset[size_]);
  std::copy(part.begin(), part.end(), whole.begin() + offset[rank_]);
  all_gather(std::span(whole), offset);
  return whole;
}

}  // namespace spume::parallel
