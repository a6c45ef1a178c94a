#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "frangia/core/pixel_buffer.h"

namespace frangia {

/// Union-find over the integers below a count. The smallest member represents each set.
///
/// @source   Tarjan 1975, Efficiency of a Good But Not Linear Set Union Algorithm (path halving)
class DisjointSets {
 public:
  /// Creates `count` sets of one integer each.
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// Returns the smallest member of the set that contains `i`.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Merges the sets that contain `a` and `b`.
  void join(std::uint32_t a, std::uint32_t b) {
    if (parent_[a] == parent_[b]) return;
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  LargeVector<std::uint32_t> parent_;
};

}  // namespace frangia
