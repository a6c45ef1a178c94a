#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia::testing {

/// Joins the points of a square grid, row by row, to two triangles a cell, but for those of which a
/// corner has no point. `number`: the vertex of each place, below 0 without one; `fits(corners)`
/// says whether the places of a triangle belong to one surface.
template <typename Fits>
void join_grid(const std::vector<std::int64_t>& number, int side, const Fits& fits, Mesh& mesh) {
  const auto add = [&](const std::array<std::size_t, 3>& places) {
    Mesh::Triangle corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (number[places.at(c)] < 0) return;
      corners.at(c) = static_cast<std::uint32_t>(number[places.at(c)]);
    }
    if (fits(places)) mesh.triangles.push_back(corners);
  };
  const auto width = static_cast<std::size_t>(side);
  for (std::size_t i = 0; i + width + 1 < width * width; ++i) {
    if (i % width + 1 == width) continue;
    add({i, i + 1, i + width + 1});
    add({i, i + width + 1, i + width});
  }
}

}  // namespace frangia::testing
