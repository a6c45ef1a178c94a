#include "frangia/geometry/aabb_tree.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::size_t kCodesPerChunk = 65'536;

/// Spreads the low 21 bits of x, with two zeros between each.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1FFFFFU;
  x = (x | x << 32U) & 0x1F00000000FFFFU;
  x = (x | x << 16U) & 0x1F0000FF0000FFU;
  x = (x | x << 8U) & 0x100F00F00F00F00FU;
  x = (x | x << 4U) & 0x10C30C30C30C30C3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

std::uint64_t morton_code(const Eigen::Vector3f& position, const Eigen::AlignedBox3f& all) {
  constexpr float kCells = 1U << 16U;
  const float side = std::max(all.sizes().maxCoeff(), 1e-30F);
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float cell = (position[axis] - all.min()[axis]) / side * kCells;
    // Coordinates near the largest float give NaN.
    const float inside = cell > 0.0F ? std::min(cell, kCells - 1.0F) : 0.0F;
    code |= spread_bits(static_cast<std::uint64_t>(inside)) << static_cast<unsigned>(axis);
  }
  return code;
}

}  // namespace

Eigen::AlignedBox3f AabbTree::box_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  Eigen::AlignedBox3f box(mesh.vertices_mm[a]);
  box.extend(mesh.vertices_mm[b]);
  box.extend(mesh.vertices_mm[c]);
  return box;
}

AabbTree::AabbTree(const Mesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  Eigen::AlignedBox3f all;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      require(vertex < mesh.vertices_mm.size(),
              "AabbTree: a triangle refers to a vertex that does not exist; repair the mesh first");
      all.extend(mesh.vertices_mm[vertex]);
    }
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> along(count);
  parallel_chunks(count, kCodesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto triangle = static_cast<std::uint32_t>(i);
      along[i] = {morton_code(box_of(mesh, triangle).center(), all), triangle};
    }
  });
  std::sort(along.begin(), along.end());
  order_.resize(count);
  triangle_boxes_.resize(count);
  leaves_ = std::bit_ceil(std::max<std::size_t>((count + kLeaf - 1) / kLeaf, 1));
  node_boxes_.resize(2 * leaves_);
  for (std::size_t i = 0; i < count; ++i) {
    order_[i] = along[i].second;
    triangle_boxes_[i] = box_of(mesh, order_[i]);
    node_boxes_[leaves_ + i / kLeaf].extend(triangle_boxes_[i]);
  }
  for (std::size_t node = leaves_ - 1; node > 0; --node)
    node_boxes_[node] = node_boxes_[2 * node].merged(node_boxes_[2 * node + 1]);
}

}  // namespace frangia
