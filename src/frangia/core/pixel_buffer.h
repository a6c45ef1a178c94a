#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
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

/// An array of fixed size in memory of `allocate_pixels`, for the pixels of an image.
///
/// A std::vector visits each element when it is destroyed, unless the compiler proves that this has
/// no effect; GCC 12 does not always. For an image of 5 Mpx that takes a few milliseconds.
template <typename T>
class PixelBuffer {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  PixelBuffer() = default;
  /// Allocates `count` elements. Numbers stay uninitialized.
  explicit PixelBuffer(std::size_t count)
      : data_(count == 0 ? nullptr : static_cast<T*>(allocate_pixels(count * sizeof(T)))),
        size_(count) {
    std::uninitialized_default_construct_n(data_, count);
  }
  /// Allocates `count` copies of `fill`.
  PixelBuffer(std::size_t count, const T& fill)
      : data_(count == 0 ? nullptr : static_cast<T*>(allocate_pixels(count * sizeof(T)))),
        size_(count) {
    std::uninitialized_fill_n(data_, count, fill);
  }
  /// Refers to `count` elements of foreign memory, which `owner` keeps alive. Copies have memory of
  /// their own.
  PixelBuffer(T* data, std::size_t count, std::shared_ptr<const void> owner)
      : data_(data), size_(count), owner_(std::move(owner)) {}
  /// Copies the elements.
  PixelBuffer(const PixelBuffer& other)
      : data_(other.empty() ? nullptr : static_cast<T*>(allocate_pixels(other.size_ * sizeof(T)))),
        size_(other.size_) {
    std::uninitialized_copy_n(other.data_, size_, data_);
  }
  /// Takes over the memory.
  PixelBuffer(PixelBuffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        owner_(std::move(other.owner_)) {}
  /// Copies the elements; keeps memory of its own if the size is the same.
  PixelBuffer& operator=(const PixelBuffer& other) {
    if (this == &other) return *this;
    if (size_ == other.size_ && !owner_) {
      std::copy_n(other.data_, size_, data_);
    } else {
      *this = PixelBuffer(other);
    }
    return *this;
  }
  /// Takes over the memory.
  PixelBuffer& operator=(PixelBuffer&& other) noexcept {
    PixelBuffer taken(std::move(other));
    std::swap(data_, taken.data_);
    std::swap(size_, taken.size_);
    std::swap(owner_, taken.owner_);
    return *this;
  }
  ~PixelBuffer() {
    if (!owner_) free_pixels(data_, size_ * sizeof(T));
  }

  [[nodiscard]] std::size_t size() const { return size_; }         ///< number of elements
  [[nodiscard]] bool empty() const { return size_ == 0; }          ///< whether it has no elements
  [[nodiscard]] T* data() { return data_; }                        ///< first element
  [[nodiscard]] const T* data() const { return data_; }            ///< first element, read-only
  [[nodiscard]] T& operator[](std::size_t i) { return data_[i]; }  ///< unchecked
  [[nodiscard]] const T& operator[](std::size_t i) const { return data_[i]; }  ///< unchecked

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::shared_ptr<const void> owner_;  ///< of foreign memory; empty: the memory is our own
};

/// Returns the pixel allocator's cached blocks to the system. Call it at the end of a stage when
/// the next stage needs images of other sizes.
void release_cached_pixels() noexcept;

}  // namespace frangia
