#include "frangia/core/pixel_buffer.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

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

/// Free large blocks, kept for the next image of the same size; consecutive views need the same
/// images. Like the free lists of malloc it is part of the allocator, and no result depends on it.
class BlockCache {
 public:
  void* take(std::size_t whole) {
    const std::scoped_lock lock(mutex_);
    const auto found = std::find_if(
        blocks_.rbegin(), blocks_.rend(), [&](const Block& block) { return block.bytes == whole; });
    if (found == blocks_.rend()) return nullptr;
    void* memory = found->memory;
    cached_bytes_ -= whole;
    blocks_.erase(std::next(found).base());
    return memory;
  }

  /// Returns false when the caller must free the block.
  bool put(void* memory, std::size_t whole) noexcept {
    if (whole > kMaxCachedBytes) return false;
    const std::scoped_lock lock(mutex_);
    if (blocks_.size() == blocks_.capacity()) free_oldest();
    while (cached_bytes_ + whole > kMaxCachedBytes)
      free_oldest();
    blocks_.push_back({memory, whole});
    cached_bytes_ += whole;
    return true;
  }

  void clear() noexcept {
    const std::scoped_lock lock(mutex_);
    while (!blocks_.empty())
      free_oldest();
  }

  BlockCache() { blocks_.reserve(64); }

 private:
  /// The frames and phase maps of one view of 20 Mpx (12 frames of 8 bits, five float maps) fit.
  static constexpr std::size_t kMaxCachedBytes = std::size_t{768} << 20U;
  struct Block {
    void* memory;
    std::size_t bytes;
  };

  void free_oldest() noexcept {
    // NOLINTNEXTLINE(cppcoreguidelines-no-malloc,cppcoreguidelines-owning-memory)
    std::free(blocks_.front().memory);
    cached_bytes_ -= blocks_.front().bytes;
    blocks_.erase(blocks_.begin());
  }

  std::mutex mutex_;
  std::vector<Block> blocks_;  ///< the most recently freed block is the last
  std::size_t cached_bytes_ = 0;
};

BlockCache& block_cache() {
  // Never destroyed, because an image of static storage duration may outlive it.
  static BlockCache* const block_cache = new BlockCache;  // NOLINT(cppcoreguidelines-owning-memory)
  return *block_cache;
}

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kCacheBlocks = false;  // keeps use-after-free errors detectable
#else
constexpr bool kCacheBlocks = true;
#endif

}  // namespace

void* allocate_pixels(std::size_t bytes) {
  const std::size_t whole = rounded(bytes);
  if (kCacheBlocks && is_large(bytes)) {
    if (void* memory = block_cache().take(whole)) return memory;
  }
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): free_pixels frees it
  void* memory = std::aligned_alloc(is_large(bytes) ? kHugePage : kCacheLine, whole);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  // Advice only: the memory also works without huge pages.
  if (is_large(bytes)) static_cast<void>(::madvise(memory, whole, MADV_HUGEPAGE));
#endif
  return memory;
}

void free_pixels(void* memory, std::size_t bytes) noexcept {
  if (memory == nullptr) return;
  // cppcheck-suppress throwInNoexceptFunction  ; it has not thrown at allocation
  if (kCacheBlocks && is_large(bytes) && block_cache().put(memory, rounded(bytes))) return;
  // NOLINTNEXTLINE(cppcoreguidelines-no-malloc,cppcoreguidelines-owning-memory): of aligned_alloc
  std::free(memory);
}

void release_cached_pixels() noexcept {
  block_cache().clear();
}

}  // namespace frangia
