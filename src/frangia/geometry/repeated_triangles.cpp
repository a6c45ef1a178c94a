#include "frangia/geometry/repeated_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace frangia {
namespace {

/// Mixes the bits of a number (splitmix64).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Hash of a position; equal for 0 and -0.
std::uint64_t hash_of(const Eigen::Vector3f& position) {
  std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
  for (const float value : position)
    hash = mixed(hash + std::bit_cast<std::uint32_t>(value + 0.0F));
  return hash;
}

/// Hash of the three positions that does not depend on their order.
std::uint64_t hash_of(const Mesh& mesh, const Mesh::Triangle& triangle) {
  std::uint64_t sum = 0;
  for (const std::uint32_t vertex : triangle)
    sum += hash_of(mesh.vertices_mm[vertex]);
  return mixed(sum);
}

bool at_same_positions(const Mesh& mesh, const Mesh::Triangle& one, const Mesh::Triangle& other) {
  return std::is_permutation(
      one.begin(), one.end(), other.begin(), [&](std::uint32_t a, std::uint32_t b) {
        return mesh.vertices_mm[a] == mesh.vertices_mm[b];
      });
}

}  // namespace

std::vector<std::uint32_t> repeated_triangles(const Mesh& mesh) {
  constexpr std::uint32_t kFree = ~0U;
  // Open addressing with at most half of the slots taken.
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * mesh.triangles.size() + 1), kFree);
  const std::size_t last = slots.size() - 1;
  std::vector<std::uint32_t> repeated;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    std::size_t at = hash_of(mesh, mesh.triangles[i]) & last;
    while (slots[at] != kFree &&
           !at_same_positions(mesh, mesh.triangles[slots[at]], mesh.triangles[i]))
      at = (at + 1) & last;
    if (slots[at] == kFree) {
      slots[at] = i;
    } else {
      repeated.push_back(i);
    }
  }
  return repeated;
}

}  // namespace frangia
