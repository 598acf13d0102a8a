#pragma once

#include <cstddef>
#include <vector>

namespace spume {

/// Numbers of keys, in one open-addressed table: made for millions of small keys that are looked up a few
/// times each and never taken out.
template <class Key, class Hash>
class FlatMap {
 public:
  explicit FlatMap(std::size_t expected = 0) {
    std::size_t size = 1024;
    while (size < 2 * expected) size *= 2;
    slots_.resize(size);
  }

  /// The number of `key`; `number` (not negative) if it had none.
  int find_or_insert(const Key& key, int number) {
    if (2 * (n_keys_ + 1) > slots_.size()) grow();
    Slot& slot = slot_of(key);
    if (slot.number < 0) {
      slot = {key, number};
      ++n_keys_;
    }
    return slot.number;
  }

 private:
  struct Slot {
    Key key{};
    int number = -1;
  };

  Slot& slot_of(const Key& key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t n = Hash{}(key)&mask;
    while (slots_[n].number >= 0 && !(slots_[n].key == key)) n = (n + 1) & mask;
    return slots_[n];
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.number >= 0) slot_of(slot.key) = slot;
  }

  std::vector<Slot> slots_;
  std::size_t n_keys_ = 0;
};

}  // namespace spume
