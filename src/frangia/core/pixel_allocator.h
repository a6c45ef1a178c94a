#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace frangia {

/// Memory for `bytes`, never null; large ones on huge pages where the system has them, and used
/// again once they are given back, because touching 20 million pixels for the first time costs more
/// than computing them. At most 768 MB are kept for that.
[[nodiscard]] void* allocate_pixels(std::size_t bytes);
/// Gives back what `allocate_pixels(bytes)` gave.
void free_pixels(void* memory, std::size_t bytes) noexcept;

/// The allocator of an Image: elements made without a value stay uninitialised.
template <typename T>
struct PixelAllocator {
  using value_type = T;

  PixelAllocator() = default;
  template <typename U>
  explicit PixelAllocator(const PixelAllocator<U>& /*other*/) noexcept {}

  [[nodiscard]] T* allocate(std::size_t count) {
    return static_cast<T*>(allocate_pixels(count * sizeof(T)));
  }
  // cppcheck-suppress throwInNoexceptFunction  ; it has not thrown at allocation
  void deallocate(T* memory, std::size_t count) noexcept { free_pixels(memory, count * sizeof(T)); }

  template <typename U>
  void construct(U* address) {
    ::new (static_cast<void*>(address)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* address, Arguments&&... arguments) {
    ::new (static_cast<void*>(address)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const PixelAllocator& /*one*/, const PixelAllocator& /*other*/) {
    return true;
  }
};

/// For millions of values; those made without a value stay uninitialised.
template <typename T>
using LargeVector = std::vector<T, PixelAllocator<T>>;

}  // namespace frangia
