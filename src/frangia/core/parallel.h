#pragma once

#include <cstddef>
#include <functional>

namespace frangia {

/// Calls `work(begin, end)` for [0, count) cut into chunks of `chunk`, on all cores.
///
/// The cuts depend on `count` and `chunk` only, never on the number of threads: work that writes
/// its own chunk, and sums that are kept per chunk and added in order, give the same bytes always.
void parallel_chunks(std::size_t count,
                     std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& work);

/// Calls `work(y)` for every row of an image, on all cores.
void parallel_rows(int height, const std::function<void(int)>& work);

}  // namespace frangia
