#include "frangia/core/pixel_allocator.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace frangia {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20U;
constexpr std::size_t kCacheLine = 64;

}  // namespace

void* allocate_pixels(std::size_t bytes) {
  const std::size_t page = bytes >= 2 * kHugePage ? kHugePage : kCacheLine;
  const std::size_t whole = (bytes + page - 1) / page * page;
  if (whole < bytes) throw std::bad_alloc();
  void* memory = std::aligned_alloc(page, whole);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  // A wish: without huge pages everything works as before.
  if (page == kHugePage) static_cast<void>(::madvise(memory, whole, MADV_HUGEPAGE));
#endif
  return memory;
}

void free_pixels(void* memory) noexcept {
  std::free(memory);  // NOLINT(cppcoreguidelines-no-malloc): the partner of aligned_alloc
}

}  // namespace frangia
