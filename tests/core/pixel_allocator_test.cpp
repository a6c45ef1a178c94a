#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "frangia/core/pixel_buffer.h"

namespace frangia {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20U;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // sanitizers replace the allocator of the system
#else
constexpr bool kSanitized = false;
#endif

struct Block {
  std::uint8_t* memory;
  std::size_t bytes;
};

bool is_filled_with(const Block& block, std::uint8_t value) {
  const std::span<const std::uint8_t> all(block.memory, block.bytes);
  return std::all_of(all.begin(), all.end(), [&](std::uint8_t byte) { return byte == value; });
}

/// Virtual memory of this process, of which a large block is part until the system has it back.
std::size_t mapped_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

TEST(PixelAllocator, BlocksAreAlignedAndKeepTheirContent) {
  std::vector<Block> blocks;
  for (const std::size_t bytes : {std::size_t{1},
                                  std::size_t{64},
                                  std::size_t{4096},
                                  3 * kMegabyte,
                                  4 * kMegabyte,
                                  9 * kMegabyte,
                                  9 * kMegabyte}) {
    auto* memory = static_cast<std::uint8_t*>(allocate_pixels(bytes));
    const auto address = reinterpret_cast<std::uintptr_t>(memory);  // NOLINT: for its alignment
    EXPECT_EQ(address % 64, 0U) << bytes;
    if (bytes >= 4 * kMegabyte) {
      EXPECT_EQ(address % (2 * kMegabyte), 0U) << bytes;
    }
    std::memset(memory, static_cast<int>(blocks.size()) + 1, bytes);
    blocks.push_back({memory, bytes});
  }
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_TRUE(is_filled_with(blocks[i], static_cast<std::uint8_t>(i + 1))) << blocks[i].bytes;
  for (const Block& block : blocks)
    free_pixels(block.memory, block.bytes);
  release_cached_pixels();
}

TEST(PixelAllocator, RefusesSizesThatOverflow) {
  EXPECT_THROW(static_cast<void>(allocate_pixels(std::numeric_limits<std::size_t>::max())),
               std::bad_alloc);
}

TEST(PixelAllocator, ReusesAFreedLargeBlockOnce) {
  if (kSanitized) GTEST_SKIP() << "sanitizers replace the allocator";
  constexpr std::size_t kBytes = 8 * kMegabyte;
  release_cached_pixels();
  void* first = allocate_pixels(kBytes);
  free_pixels(first, kBytes);
  void* second = allocate_pixels(kBytes - 100);  // the same number of huge pages
  void* third = allocate_pixels(kBytes);
  EXPECT_EQ(second, first);
  EXPECT_NE(third, second);
  free_pixels(second, kBytes - 100);
  free_pixels(third, kBytes);
  release_cached_pixels();
}

TEST(PixelAllocator, KeepsAtMost768MegabytesUntilTheyAreReleased) {
  if (kSanitized) GTEST_SKIP() << "sanitizers replace the allocator";
  constexpr std::size_t kBytes = 256 * kMegabyte;
  release_cached_pixels();
  const std::size_t before = mapped_bytes();
  std::vector<void*> blocks;  // never written, so that they are virtual memory only
  for (int i = 0; i < 4; ++i)
    blocks.push_back(allocate_pixels(kBytes));
  EXPECT_GE(mapped_bytes(), before + 4 * kBytes);
  for (void* block : blocks)
    free_pixels(block, kBytes);
  EXPECT_NEAR(static_cast<double>(mapped_bytes() - before) / kMegabyte, 768.0, 20.0);
  release_cached_pixels();
  EXPECT_LT(mapped_bytes(), before + 20 * kMegabyte);
}

}  // namespace
}  // namespace frangia
