#pragma once

#include <cstddef>

#include "frangia/core/parallel.h"
#include "frangia/core/run.h"

namespace frangia {

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
