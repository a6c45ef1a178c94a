#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frangia {

/// Triangles picked out of a mesh: one flag a triangle, 0 or 1.
using Selection = std::vector<std::uint8_t>;

[[nodiscard]] inline std::size_t count_selected(const Selection& selection) {
  std::size_t count = 0;
  for (const std::uint8_t flag : selection)
    count += flag;
  return count;
}

}  // namespace frangia
