#include "frangia/core/parallel.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace frangia {

void parallel_chunks(std::size_t count,
                     std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& work) {
  if (count == 0) return;
  const std::size_t chunks = (count + chunk - 1) / chunk;
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t i) {
    work(i * chunk, std::min(count, (i + 1) * chunk));
  });
}

void parallel_rows(int height, const std::function<void(int)>& work) {
  tbb::parallel_for(0, height, [&](int y) { work(y); });
}

}  // namespace frangia
