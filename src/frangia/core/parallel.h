#pragma once

#include <cstddef>
#include <functional>

#include "frangia/core/run.h"

namespace frangia {

/// Calls `work(begin, end)` for consecutive chunks of [0, count), on all cores.
///
/// The chunks depend on `count` and `chunk` only, not on the number of threads. Results are
/// therefore identical for any number of threads if `work` writes its own chunk only and the caller
/// adds per-chunk sums in order.
void parallel_chunks(std::size_t count,
                     std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& work);

/// Calls `work(y)` for every row of an image, on all cores.
void parallel_rows(int height, const std::function<void(int)>& work);

/// Performs `parallel_chunks`, but skips the chunks that have not begun when a stop is requested,
/// and throws after the last one.
///
/// @errors   Error(Cancelled) when `run` is cancelled
template <typename Work>
void interruptible_chunks(std::size_t count, std::size_t chunk, const Run& run, const Work& work) {
  run.check();
  parallel_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    if (!run.stop.stop_requested()) work(begin, end);
  });
  run.check();
}

}  // namespace frangia
