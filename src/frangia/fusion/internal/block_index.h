#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// A block's place as one number; places run from -2^20 to 2^20 - 1.
[[nodiscard]] constexpr std::uint64_t block_key(int x, int y, int z) {
  constexpr int kOffset = 1 << 20;
  return (static_cast<std::uint64_t>(z + kOffset) << 42) |
         (static_cast<std::uint64_t>(y + kOffset) << 21) | static_cast<std::uint64_t>(x + kOffset);
}
[[nodiscard]] inline std::uint64_t block_key(const Eigen::Vector3i& coords) {
  return block_key(coords.x(), coords.y(), coords.z());
}

/// Numbers of blocks by `block_key`: a table without pointers, since it is asked millions of times.
class BlockIndex {
 public:
  static constexpr std::uint32_t kNone = ~0U;

  /// The block's number, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const {
    return slots_.empty() ? kNone : slots_[slot_of(key)].number;
  }
  /// Adds a block that is not there yet.
  void add(std::uint64_t key, std::uint32_t number);

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kNone;  ///< of an empty slot
  };

  /// The slot that holds the key, or the empty one where it belongs.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    constexpr std::uint64_t kScramble = 0x9e3779b97f4a7c15ULL;
    std::size_t slot = static_cast<std::size_t>(key * kScramble >> 32) & mask;
    while (slots_[slot].number != kNone && slots_[slot].key != key)
      slot = (slot + 1) & mask;
    return slot;
  }

  std::vector<Slot> slots_;  ///< a power of two, at most half of them taken
  std::size_t size_ = 0;
};

}  // namespace frangia
