#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "frangia/core/pixel_buffer.h"

namespace frangia {

/// A growing array stored in chunks of equal size on huge pages. Appending never moves existing
/// elements. The pixel allocator reuses released chunks, because touching new memory for the first
/// time costs as much as computing its content.
///
/// @missing  new elements are uninitialized
template <typename T>
class ChunkedVector {
 public:
  ChunkedVector() = default;
  /// Creates `count` uninitialized elements.
  explicit ChunkedVector(std::size_t count) {
    chunks_.reserve((count + kChunkSize - 1) / kChunkSize);
    while (chunks_.size() * kChunkSize < count)
      chunks_.emplace_back(kChunkCapacity);
    size_ = count;
  }

  [[nodiscard]] std::size_t size() const { return size_; }  ///< number of elements
  [[nodiscard]] bool empty() const { return size_ == 0; }   ///< whether it has no elements
  /// Element `i`, unchecked.
  [[nodiscard]] T& operator[](std::size_t i) { return chunks_[i / kChunkSize][i % kChunkSize]; }
  /// Returns element `i`, unchecked.
  [[nodiscard]] const T& operator[](std::size_t i) const {
    return chunks_[i / kChunkSize][i % kChunkSize];
  }
  /// Appends one element and leaves its value uninitialized.
  void append_uninitialized() {
    if (size_ == chunks_.size() * kChunkSize) chunks_.emplace_back(kChunkCapacity);
    ++size_;
  }

 private:
  /// A few huge pages per chunk: the allocator caches blocks of at least 4 MB.
  static constexpr std::size_t kBytes = std::size_t{4} << 20U;
  static constexpr std::size_t kChunkCapacity = kBytes / sizeof(T);
  static constexpr std::size_t kChunkSize =
      std::bit_floor(kChunkCapacity);  ///< a power of two: the index of a chunk is a shift
  std::vector<LargeVector<T>> chunks_;
  std::size_t size_ = 0;
};

}  // namespace frangia
