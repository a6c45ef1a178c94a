#include "frangia/files/internal/split_spatially.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Group = std::span<std::uint32_t>;

Eigen::Vector3f corner_sum(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return mesh.vertices_mm[a] + mesh.vertices_mm[b] + mesh.vertices_mm[c];
}

bool fits(const Mesh& mesh, Group group, std::size_t max_count) {
  if (group.size() > max_count) return false;
  return 3 * group.size() <= max_count || vertices_of(mesh, group).size() <= max_count;
}

/// Partitions the group at the median along the longest side of its bounding box. Ties are broken
/// by index, so the result is deterministic.
void partition_at_median(const Mesh& mesh, Group group) {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t triangle : group)
    box.extend(corner_sum(mesh, triangle));
  Eigen::Index longest = 0;
  box.sizes().maxCoeff(&longest);
  std::vector<std::pair<float, std::uint32_t>> order;
  order.reserve(group.size());
  for (const std::uint32_t triangle : group)
    order.emplace_back(corner_sum(mesh, triangle)[longest], triangle);
  std::nth_element(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2), order.end());
  std::transform(
      order.begin(), order.end(), group.begin(), [](const auto& entry) { return entry.second; });
}

void split(const Mesh& mesh,
           Group group,
           std::size_t max_count,
           std::vector<std::vector<std::uint32_t>>& groups) {
  if (group.empty()) return;
  if (fits(mesh, group, max_count)) {
    groups.emplace_back(group.begin(), group.end());
    std::sort(groups.back().begin(), groups.back().end());
    return;
  }
  partition_at_median(mesh, group);
  split(mesh, group.first(group.size() / 2), max_count, groups);
  split(mesh, group.subspan(group.size() / 2), max_count, groups);
}

}  // namespace

std::vector<std::vector<std::uint32_t>> split_spatially(const Mesh& mesh,
                                                        std::span<const std::uint32_t> triangles,
                                                        std::size_t max_count) {
  require(max_count >= 3, "the limit of a group of triangles must be at least 3");
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::uint32_t> order(triangles.begin(), triangles.end());
  split(mesh, order, max_count, groups);
  return groups;
}

std::vector<std::uint32_t> vertices_of(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(3 * triangles.size());
  for (const std::uint32_t triangle : triangles) {
    const Mesh::Triangle& corners = mesh.triangles[triangle];
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace frangia
