#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/core/pixel_allocator.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The triangles around each vertex of a mesh, in ascending order.
class OneRings {
 public:
  explicit OneRings(const Mesh& mesh);

  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return {triangles_.data() + first_[vertex], triangles_.data() + first_[vertex + 1]};
  }

 private:
  LargeVector<std::uint32_t> first_;
  LargeVector<std::uint32_t> triangles_;
};

/// A vertex and those that edges join to it within `rings` steps and, in a straight line,
/// `reach_mm`, in the order in which the surface reaches them.
[[nodiscard]] std::vector<std::uint32_t> vertices_within(
    const Mesh& mesh, const OneRings& one_rings, std::uint32_t vertex, int rings, float reach_mm);

}  // namespace frangia
