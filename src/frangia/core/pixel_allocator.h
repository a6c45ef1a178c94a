#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace frangia {

/// Allocates `bytes`; never returns null. Blocks of 4 MB or more lie on huge pages where the system
/// has them, and `free_pixels` keeps up to 768 MB of them for reuse: touching 20 million pixels for
/// the first time costs more than computing them.
///
/// @errors   std::bad_alloc
[[nodiscard]] void* allocate_pixels(std::size_t bytes);
/// Frees memory that `allocate_pixels(bytes)` returned. `bytes` must be the same.
void free_pixels(void* memory, std::size_t bytes) noexcept;

/// The allocator of LargeVector. Elements constructed without a value stay uninitialized.
template <typename T>
struct PixelAllocator {
  using value_type = T;  ///< type of a pixel

  PixelAllocator() = default;
  /// Converts from the allocator of another type; allocators have no state.
  template <typename U>
  explicit PixelAllocator(const PixelAllocator<U>& /*other*/) noexcept {}

  /// Allocates memory for `count` elements without constructing them.
  [[nodiscard]] T* allocate(std::size_t count) {
    return static_cast<T*>(allocate_pixels(count * sizeof(T)));
  }
  // cppcheck-suppress throwInNoexceptFunction  ; it has not thrown at allocation
  /// Frees memory that `allocate` returned for the same `count`.
  void deallocate(T* memory, std::size_t count) noexcept { free_pixels(memory, count * sizeof(T)); }

  /// Default-initializes an element: a number stays uninitialized.
  template <typename U>
  void construct(U* address) {
    ::new (static_cast<void*>(address)) U;
  }
  /// Constructs an element from arguments.
  template <typename U, typename... Arguments>
  void construct(U* address, Arguments&&... arguments) {
    ::new (static_cast<void*>(address)) U(std::forward<Arguments>(arguments)...);
  }
  /// All allocators are equal: each can free the memory of another.
  friend bool operator==(const PixelAllocator& /*one*/, const PixelAllocator& /*other*/) {
    return true;
  }
};

/// A vector for millions of values. Elements constructed without a value stay uninitialized.
template <typename T>
using LargeVector = std::vector<T, PixelAllocator<T>>;

}  // namespace frangia
