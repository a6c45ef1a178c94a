#include "frangia/core/pixel_allocator.h"

#include <cstring>

#include <gtest/gtest.h>

#include "frangia/core/release_cached_pixels.h"

namespace frangia {
namespace {

TEST(PixelAllocator, GivesMemoryOfEverySizeThatCanBeWrittenAndGivenBack) {
  for (const std::size_t bytes : {1U, 64U, 4096U, 3U << 20U, 9U << 20U}) {
    void* memory = allocate_pixels(bytes);
    std::memset(memory, 0x5a, bytes);
    free_pixels(memory, bytes);
  }
  release_cached_pixels();
}

TEST(PixelAllocator, NeverGivesOneBlockTwice) {
  constexpr std::size_t kBytes = std::size_t{8} << 20U;
  void* first = allocate_pixels(kBytes);
  free_pixels(first, kBytes);
  void* second = allocate_pixels(kBytes);
  void* third = allocate_pixels(kBytes);
  EXPECT_NE(second, third);
  free_pixels(second, kBytes);
  free_pixels(third, kBytes);
  release_cached_pixels();
}

}  // namespace
}  // namespace frangia
