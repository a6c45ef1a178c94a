#include "frangia/core/parallel.h"

#include <algorithm>

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <future>
#include <vector>
#else
#include <tbb/parallel_for.h>
#endif

namespace frangia {
namespace {

#ifdef __SANITIZE_THREAD__
/// Debian's TBB is not built for the thread sanitizer, which then reports false races. Standard
/// threads let the sanitizer check the library's own code.
template <typename Work>
void parallel_indices(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++)
      work(i);
  };
  std::vector<std::future<void>> others;
  for (int i = 0; i < 3; ++i)
    others.push_back(std::async(std::launch::async, take));
  take();
  for (auto& other : others)
    other.get();
}
#else
template <typename Work>
void parallel_indices(std::size_t count, const Work& work) {
  tbb::parallel_for(std::size_t{0}, count, work);
}
#endif

}  // namespace

void parallel_chunks(std::size_t count,
                     std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& work) {
  if (count == 0) return;
  const std::size_t chunks = (count + chunk - 1) / chunk;
  parallel_indices(chunks,
                   [&](std::size_t i) { work(i * chunk, std::min(count, (i + 1) * chunk)); });
}

void parallel_rows(int height, const std::function<void(int)>& work) {
  if (height <= 0) return;
  parallel_indices(static_cast<std::size_t>(height),
                   [&](std::size_t y) { work(static_cast<int>(y)); });
}

}  // namespace frangia
