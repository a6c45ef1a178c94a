#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Whether a triangle's height over its longest edge is below `lowest_mm`.
[[nodiscard]] bool is_low(const Mesh& mesh, const Mesh::Triangle& t, float lowest_mm);

/// The few triangles of a mesh that may be slivers or caps.
class SliverCandidates {
 public:
  /// Collects triangles with an edge shorter than `shortest_mm` or a height below `lowest_mm`.
  SliverCandidates(const Mesh& mesh, float shortest_mm, float lowest_mm);

  /// The candidates in ascending order.
  [[nodiscard]] const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  /// Adds triangles in ascending order that have changed or whose neighbours have.
  void add(const std::vector<std::uint32_t>& triangles);

 private:
  std::vector<std::uint32_t> triangles_;
};

}  // namespace frangia
