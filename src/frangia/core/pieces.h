#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "frangia/core/pixel_allocator.h"

namespace frangia {

/// Many values in pieces of one size on huge pages. They stay where they are while others are
/// added, and the memory that one kind gives back is what the next kind takes: to touch memory for
/// the first time costs as much as to compute what it holds.
///
/// missing  new values hold nothing yet, not even zeros
template <typename T>
class Pieces {
 public:
  Pieces() = default;
  explicit Pieces(std::size_t count) {
    pieces_.reserve((count + kPiece - 1) / kPiece);
    while (pieces_.size() * kPiece < count)
      pieces_.emplace_back(kRoom);
    size_ = count;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T& operator[](std::size_t i) { return pieces_[i / kPiece][i % kPiece]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return pieces_[i / kPiece][i % kPiece]; }
  void add() {
    if (size_ == pieces_.size() * kPiece) pieces_.emplace_back(kRoom);
    ++size_;
  }

 private:
  static constexpr std::size_t kBytes = std::size_t{4} << 20U;
  static constexpr std::size_t kRoom = kBytes / sizeof(T);
  static constexpr std::size_t kPiece = std::bit_floor(kRoom);  ///< used: a shift finds it
  std::vector<LargeVector<T>> pieces_;
  std::size_t size_ = 0;
};

}  // namespace frangia
