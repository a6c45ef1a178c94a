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

bool fits(const Mesh& mesh, Group group, std::size_t most) {
  if (group.size() > most) return false;
  return 3 * group.size() <= most || vertices_of(mesh, group).size() <= most;
}

/// Orders the group so that its halves lie apart. Ties go by index, so the halves are always the
/// same.
void partition_at_median(const Mesh& mesh, Group group) {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t triangle : group)
    box.extend(corner_sum(mesh, triangle));
  Eigen::Index longest = 0;
  box.sizes().maxCoeff(&longest);
  std::vector<std::pair<float, std::uint32_t>> places;
  places.reserve(group.size());
  for (const std::uint32_t triangle : group)
    places.emplace_back(corner_sum(mesh, triangle)[longest], triangle);
  std::nth_element(places.begin(),
                   places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2),
                   places.end());
  std::transform(
      places.begin(), places.end(), group.begin(), [](const auto& place) { return place.second; });
}

void split(const Mesh& mesh,
           Group group,
           std::size_t most,
           std::vector<std::vector<std::uint32_t>>& groups) {
  if (group.empty()) return;
  if (fits(mesh, group, most)) {
    groups.emplace_back(group.begin(), group.end());
    std::sort(groups.back().begin(), groups.back().end());
    return;
  }
  partition_at_median(mesh, group);
  split(mesh, group.first(group.size() / 2), most, groups);
  split(mesh, group.subspan(group.size() / 2), most, groups);
}

}  // namespace

std::vector<std::vector<std::uint32_t>> split_spatially(const Mesh& mesh,
                                                        std::span<const std::uint32_t> triangles,
                                                        std::size_t most) {
  require(most >= 3, "split_spatially: a group must hold the three corners of a triangle");
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::uint32_t> order(triangles.begin(), triangles.end());
  split(mesh, order, most, groups);
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
