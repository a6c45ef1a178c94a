#pragma once

#include <cstddef>
#include <functional>

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

}  // namespace frangia
