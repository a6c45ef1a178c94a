#include "frangia/acceptance/internal/ball_region.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace frangia {
namespace {

bool is_measured(const Mesh& mesh, std::size_t triangle) {
  if (!mesh.triangle_marks.empty() && mesh.triangle_marks[triangle] != Mark::Measured) return false;
  return mesh.vertex_marks.empty() ||
         std::all_of(mesh.triangles[triangle].begin(), mesh.triangles[triangle].end(), [&](auto v) {
           return mesh.vertex_marks[v] == Mark::Measured;
         });
}

}  // namespace

BallRegion ball_region(const Mesh& mesh, const Shape& sphere, double gate_mm) {
  const auto residual = [&](std::size_t v) {
    return (mesh.vertices_mm[v].cast<double>() - sphere.center_mm).norm() - sphere.radius_mm;
  };
  std::vector<char> on(mesh.vertices_mm.size(), 0);
  for (std::size_t v = 0; v < on.size(); ++v)
    on[v] = std::abs(residual(v)) < gate_mm ? 1 : 0;
  std::vector<char> used(on.size(), 0);
  std::vector<char> border(on.size(), 0);
  std::vector<std::uint64_t> turn(on.size(), 0);  // sums of next - previous around a vertex
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Mesh::Triangle& corners = mesh.triangles[t];
    const bool whole =
        is_measured(mesh, t) &&
        std::all_of(corners.begin(), corners.end(), [&](auto v) { return on[v] != 0; });
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = corners[k];
      if (on[v] == 0) continue;
      if (!whole) {
        border[v] = 1;
      } else {
        used[v] = 1;
        turn[v] += corners[(k + 1) % 3];
        turn[v] -= corners[(k + 2) % 3];
      }
    }
  }
  BallRegion region;
  for (std::size_t v = 0; v < on.size(); ++v) {
    if (used[v] == 0) continue;
    if (border[v] != 0 || turn[v] != 0) {
      region.borders.push_back(
          (mesh.vertices_mm[v].cast<double>() - sphere.center_mm).normalized());
    } else {
      region.vertices.push_back(v);
    }
  }
  return region;
}

}  // namespace frangia
