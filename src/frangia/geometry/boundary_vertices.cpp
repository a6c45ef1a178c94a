#include "frangia/geometry/boundary_vertices.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "frangia/core/pixel_allocator.h"

namespace frangia {
namespace {

/// Hashes a vertex number (splitmix64), so that sums over different edges differ.
std::uint64_t hashed(std::uint32_t i) {
  std::uint64_t x = i + 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

// Around an inner vertex, each neighbour follows and precedes the vertex equally often, so the sum
// of the signed hashes is zero.
std::vector<bool> boundary_vertices(const Mesh& mesh) {
  LargeVector<std::uint64_t> balance(mesh.vertices_mm.size(), 0);
  for (const auto& t : mesh.triangles) {
    const std::array<std::uint64_t, 3> number{hashed(t[0]), hashed(t[1]), hashed(t[2])};
    for (std::size_t i = 0; i < 3; ++i)
      balance[t[i]] += number[(i + 1) % 3] - number[(i + 2) % 3];
  }
  std::vector<bool> boundary(balance.size());
  for (std::size_t i = 0; i < boundary.size(); ++i)
    boundary[i] = balance[i] != 0;
  return boundary;
}

}  // namespace frangia
