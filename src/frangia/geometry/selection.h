#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frangia {

/// A selection of triangles: one flag, 0 or 1, for each triangle of a mesh.
using Selection = std::vector<std::uint8_t>;

/// Returns the number of selected triangles.
[[nodiscard]] inline std::size_t count_selected(const Selection& selection) {
  std::size_t count = 0;
  for (const std::uint8_t flag : selection)
    count += flag;
  return count;
}

}  // namespace frangia
