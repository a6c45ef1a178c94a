#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// The coordinates of a block packed into one number; each runs from -2^20 to 2^20 - 1.
[[nodiscard]] constexpr std::uint64_t block_key(int x, int y, int z) {
  constexpr int kOffset = 1 << 20;
  return (static_cast<std::uint64_t>(z + kOffset) << 42) |
         (static_cast<std::uint64_t>(y + kOffset) << 21) | static_cast<std::uint64_t>(x + kOffset);
}
[[nodiscard]] inline std::uint64_t block_key(const Eigen::Vector3i& coords) {
  return block_key(coords.x(), coords.y(), coords.z());
}

/// Maps `block_key` to block numbers: an open-addressing hash table for millions of look-ups.
class BlockIndex {
 public:
  static constexpr std::uint32_t kNone = ~0U;

  /// Returns the block's number, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const {
    return slots_.empty() ? kNone : slots_[slot_of(key)].number;
  }
  /// Adds a block whose key is not in the table yet.
  void add(std::uint64_t key, std::uint32_t number);

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kNone;  ///< kNone in an empty slot
  };

  /// Returns the slot that holds the key, or the empty slot where it would be added.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    constexpr std::uint64_t kScramble = 0x9e3779b97f4a7c15ULL;
    std::size_t slot = static_cast<std::size_t>(key * kScramble >> 32) & mask;
    while (slots_[slot].number != kNone && slots_[slot].key != key)
      slot = (slot + 1) & mask;
    return slot;
  }

  std::vector<Slot> slots_;  ///< a power of two, at most half of them used
  std::size_t size_ = 0;
};

}  // namespace frangia
