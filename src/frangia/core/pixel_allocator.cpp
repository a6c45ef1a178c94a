#include "frangia/core/pixel_allocator.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

#include "frangia/core/spare_pixels.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace frangia {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20U;
constexpr std::size_t kCacheLine = 64;

bool is_large(std::size_t bytes) {
  return bytes >= 2 * kHugePage;
}

std::size_t rounded(std::size_t bytes) {
  const std::size_t page = is_large(bytes) ? kHugePage : kCacheLine;
  const std::size_t whole = (bytes + page - 1) / page * page;
  if (whole < bytes) throw std::bad_alloc();
  return whole;
}

/// Large blocks that were given back, for the next image of that size: the images of one view are
/// those of the view before. Part of the allocator, as malloc's own lists are: no result depends
/// on it.
class Shelf {
 public:
  void* take(std::size_t whole) {
    const std::scoped_lock lock(mutex_);
    const auto found = std::find_if(
        blocks_.rbegin(), blocks_.rend(), [&](const Block& block) { return block.bytes == whole; });
    if (found == blocks_.rend()) return nullptr;
    void* memory = found->memory;
    kept_ -= whole;
    blocks_.erase(std::next(found).base());
    return memory;
  }

  /// False where the block should be freed.
  bool put(void* memory, std::size_t whole) noexcept {
    if (whole > kMost) return false;
    const std::scoped_lock lock(mutex_);
    if (blocks_.size() == blocks_.capacity()) drop_oldest();
    while (kept_ + whole > kMost)
      drop_oldest();
    blocks_.push_back({memory, whole});
    kept_ += whole;
    return true;
  }

  void clear() noexcept {
    const std::scoped_lock lock(mutex_);
    while (!blocks_.empty())
      drop_oldest();
  }

  Shelf() { blocks_.reserve(64); }

 private:
  static constexpr std::size_t kMost = std::size_t{768} << 20U;
  struct Block {
    void* memory;
    std::size_t bytes;
  };

  void drop_oldest() noexcept {
    // NOLINTNEXTLINE(cppcoreguidelines-no-malloc,cppcoreguidelines-owning-memory)
    std::free(blocks_.front().memory);
    kept_ -= blocks_.front().bytes;
    blocks_.erase(blocks_.begin());
  }

  std::mutex mutex_;
  std::vector<Block> blocks_;  ///< the last given back comes last
  std::size_t kept_ = 0;       ///< bytes
};

Shelf& shelf() {
  // Never destroyed: an image of static duration may outlive it.
  static Shelf* const shelf = new Shelf;  // NOLINT(cppcoreguidelines-owning-memory)
  return *shelf;
}

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kShelves = false;  // so that a use after free shows
#else
constexpr bool kShelves = true;
#endif

}  // namespace

void* allocate_pixels(std::size_t bytes) {
  const std::size_t whole = rounded(bytes);
  if (kShelves && is_large(bytes)) {
    if (void* memory = shelf().take(whole)) return memory;
  }
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): free_pixels gives it back
  void* memory = std::aligned_alloc(is_large(bytes) ? kHugePage : kCacheLine, whole);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  // A wish: without huge pages everything works as before.
  if (is_large(bytes)) static_cast<void>(::madvise(memory, whole, MADV_HUGEPAGE));
#endif
  return memory;
}

void free_pixels(void* memory, std::size_t bytes) noexcept {
  if (memory == nullptr) return;
  // cppcheck-suppress throwInNoexceptFunction  ; it has not thrown at allocation
  if (kShelves && is_large(bytes) && shelf().put(memory, rounded(bytes))) return;
  // NOLINTNEXTLINE(cppcoreguidelines-no-malloc,cppcoreguidelines-owning-memory): of aligned_alloc
  std::free(memory);
}

void release_spare_pixels() noexcept {
  shelf().clear();
}

}  // namespace frangia
