#include "frangia/fusion/internal/settle_bends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace frangia {
namespace {

/// How far the vertices beside each lie from its tangent plane.
struct Rise {
  float most_mm = 0.0F;
  float steepest = 0.0F;  ///< sine of the angle that one of them is seen under
};

std::vector<Rise> rises_of(const Mesh& mesh) {
  std::vector<Rise> rises(mesh.vertices_mm.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangle.at(i);
      for (std::size_t other = 1; other < 3; ++other) {
        const std::uint32_t beside = triangle.at((i + other) % 3);
        const Eigen::Vector3f way = mesh.vertices_mm[beside] - mesh.vertices_mm[v];
        const float rise = std::abs(mesh.normals[v].dot(way));
        rises[v].most_mm = std::max(rises[v].most_mm, rise);
        const float length = way.norm();
        if (length > 0.0F) rises[v].steepest = std::max(rises[v].steepest, rise / length);
      }
    }
  }
  return rises;
}

/// What counts of a bend of one face. The surface is off by 0 to angle * edge / 4, evenly
/// distributed, which is rise / 2; at a step anywhere within the rise.
float counted(float bend_mm, const Rise& rise) {
  constexpr float kOfRise = 0.1443F;  // 1 / 2 / sqrt(12)
  constexpr float kOfStep = 0.2887F;  // 1 / sqrt(12)
  constexpr float kStep = 0.26F;      // sine of 15 degrees: beyond, the planes are not one face
  if (rise.steepest > kStep) return std::max(bend_mm, kOfStep * rise.most_mm);
  return std::min(bend_mm, kOfRise * rise.most_mm);
}

}  // namespace

void settle_bends(PlacedVertices& vertices, std::span<const std::uint8_t> on_edge) {
  Mesh& mesh = vertices.mesh;
  const std::vector<Rise> rises = rises_of(mesh);
  for (std::size_t v = 0; v < vertices.bend_mm.size(); ++v) {
    if (vertices.sharp[v] != 0 || on_edge[v] != 0) continue;
    const float bend = vertices.bend_mm[v];
    const float counts = counted(bend, rises[v]);
    float& sigma = mesh.sigma_mm[v];
    sigma = std::sqrt(std::max(0.0F, sigma * sigma - bend * bend) + counts * counts);
  }
}

}  // namespace frangia
