#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/geometry/mesh.h"

namespace frangia::testing {

/// Signed volume: positive for a closed mesh whose triangles face outwards.
inline double volume_mm3(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += mesh.vertices_mm[a].cast<double>().dot(
        mesh.vertices_mm[b].cast<double>().cross(mesh.vertices_mm[c].cast<double>()));
  }
  return sum / 6.0;
}

/// Edges that are not in exactly two triangles, once in each direction: none for a closed surface.
inline std::size_t open_edges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      ++uses[{triangle[i], triangle[(i + 1) % 3]}];
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (count != 1 || back == uses.end()) ++open;
  }
  return open;
}

/// Adds the shadow of a sheet that is seen from +z, at z = 0 and seen from below; its sides stay
/// open.
inline void add_floor(Mesh& sheet) {
  const auto top = static_cast<std::uint32_t>(sheet.vertices_mm.size());
  for (std::uint32_t i = 0; i < top; ++i)
    sheet.vertices_mm.emplace_back(sheet.vertices_mm[i].x(), sheet.vertices_mm[i].y(), 0.0F);
  const auto upper = sheet.triangles;
  for (const auto& [a, b, c] : upper)
    sheet.triangles.push_back({a + top, c + top, b + top});
}

/// A level sheet of vertices 1 mm apart, seen from +z.
inline Mesh level_grid(std::uint32_t width, std::uint32_t height) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    const std::uint32_t row = i / width;
    mesh.vertices_mm.emplace_back(static_cast<float>(i % width), static_cast<float>(row), 0.0F);
    if (i % width == width - 1 || row == height - 1) continue;
    mesh.triangles.push_back({i, i + 1, i + width + 1});
    mesh.triangles.push_back({i, i + width + 1, i + width});
  }
  return mesh;
}

/// An open relief of 49 x 49 mm with waves of 8 mm, seen from +z; one vertex a millimetre.
inline Mesh relief() {
  constexpr std::uint32_t kSide = 50;
  Mesh mesh = level_grid(kSide, kSide);
  for (Eigen::Vector3f& vertex : mesh.vertices_mm)
    vertex.z() = 8.0F * std::sin(0.1F * vertex.x()) * std::cos(0.08F * vertex.y());
  return mesh;
}

/// A box from one corner to the other, of twelve triangles.
inline Mesh box(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices_mm.emplace_back((i & 1U) != 0 ? high.x() : low.x(),
                                  (i & 2U) != 0 ? high.y() : low.y(),
                                  (i & 4U) != 0 ? high.z() : low.z());
  }
  mesh.triangles = {{0, 2, 1},
                    {1, 2, 3},
                    {4, 5, 6},
                    {5, 7, 6},
                    {0, 1, 4},
                    {1, 5, 4},
                    {2, 6, 3},
                    {3, 6, 7},
                    {0, 4, 2},
                    {2, 4, 6},
                    {1, 3, 5},
                    {3, 7, 5}};
  return mesh;
}

/// A sphere of rings and meridians.
inline Mesh sphere(const Eigen::Vector3d& center, double radius, int rings = 90) {
  Mesh mesh;
  const int round = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    const double polar = kPi * i / rings;
    const int count = i == 0 || i == rings ? 1 : round;
    for (int j = 0; j < count; ++j) {
      const double turn = kTwoPi * j / round;
      const Eigen::Vector3d out(
          std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      mesh.vertices_mm.emplace_back((center + radius * out).cast<float>());
    }
  }
  const auto at = [&](int i, int j) {
    if (i == 0) return std::uint32_t{0};
    const int index = i == rings ? 1 + (rings - 1) * round : 1 + (i - 1) * round + j % round;
    return static_cast<std::uint32_t>(index);
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < round; ++j) {
      if (i + 1 < rings) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace frangia::testing
