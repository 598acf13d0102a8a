#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "spume/base/contract.hpp"

namespace spume::mesh {

/// A phase: 0 is the outside, 1, 2, … are bubbles. Ids are never used again.
using Phase = std::int32_t;

/// The few phases that meet at a point, in increasing order: 2 on a film, 3 on a Plateau border, 4 or more at
/// a junction.
class PhaseSet {
 public:
  static constexpr int capacity = 12;

  PhaseSet() = default;
  PhaseSet(std::initializer_list<Phase> phases) {
    for (Phase p : phases) insert(p);
  }

  void insert(Phase p) {
    if (contains(p)) return;
    expects(size_ < capacity, "at most twelve phases meet at a point");
    int n = size_++;
    for (; n > 0 && phases_[n - 1] > p; --n) phases_[n] = phases_[n - 1];
    phases_[n] = p;
  }
  bool contains(Phase p) const { return std::find(begin(), end(), p) != end(); }
  bool contains(const PhaseSet& other) const {
    return std::includes(begin(), end(), other.begin(), other.end());
  }

  int size() const { return size_; }
  Phase operator[](int n) const { return phases_[n]; }
  const Phase* begin() const { return phases_.data(); }
  const Phase* end() const { return phases_.data() + size_; }

  bool operator==(const PhaseSet& b) const { return std::equal(begin(), end(), b.begin(), b.end()); }
  /// Lexicographic, for keys of ordered maps.
  bool operator<(const PhaseSet& b) const {
    return std::lexicographical_compare(begin(), end(), b.begin(), b.end());
  }

 private:
  std::array<Phase, capacity> phases_{};
  std::int32_t size_ = 0;
};

struct PhaseSetHash {
  std::size_t operator()(const PhaseSet& set) const {
    std::uint64_t h = 0xcbf29ce484222325ull;
    for (Phase p : set) h = (h ^ static_cast<std::uint64_t>(p + 1)) * 0x9E3779B97F4A7C15ull;
    return h ^ (h >> 29);
  }
};

}  // namespace spume::mesh
