#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "frangia/core/random.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/stitch.h"

#include "support/test_meshes.h"

namespace frangia::testing {

constexpr double kBallRadius = 20.0;

inline Mesh ball() {
  return sphere(Eigen::Vector3d::Zero(), kBallRadius, 40);
}

/// The ball with a hole of 20 mm at its equator, away from the poles of its triangulation.
inline Mesh holed_ball() {
  const Mesh mesh = ball();
  return delete_selected(mesh, select_by_ball(mesh, {kBallRadius, 0.0, 0.0}, 10.0));
}

/// Splits each triangle into four.
inline Mesh finer(const Mesh& mesh) {
  Mesh cut = mesh;
  cut.triangles.clear();
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = add_interpolated_vertex(cut, a, b, 0.5F);
    const std::uint32_t bc = add_interpolated_vertex(cut, b, c, 0.5F);
    const std::uint32_t ca = add_interpolated_vertex(cut, c, a, 0.5F);
    for (const auto& t : {Mesh::Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      cut.triangles.push_back(t);
  }
  // Each triangle has its own midpoints: merge them.
  return stitch(cut, 1e-5);
}

/// A ball of triangles of similar size: a subdivided octahedron.
inline Mesh even_ball() {
  Mesh mesh;
  for (const float s : {1.0F, -1.0F}) {
    for (int axis = 0; axis < 3; ++axis)
      mesh.vertices_mm.emplace_back(s * Eigen::Vector3f::Unit(axis));
  }
  mesh.triangles = {
      {0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  for (int round = 0; round < 5; ++round) {
    mesh = finer(mesh);
    for (auto& vertex : mesh.vertices_mm)
      vertex.normalize();
  }
  for (auto& vertex : mesh.vertices_mm)
    vertex *= static_cast<float>(kBallRadius);
  return mesh;
}

inline double farthest_from_ball(const Mesh& mesh) {
  double farthest = 0.0;
  for (const auto& vertex : mesh.vertices_mm)
    farthest = std::max(farthest, std::abs(vertex.cast<double>().norm() - kBallRadius));
  return farthest;
}

inline double rms_from_ball(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& vertex : mesh.vertices_mm)
    sum += std::pow(vertex.cast<double>().norm() - kBallRadius, 2);
  return std::sqrt(sum / static_cast<double>(mesh.vertices_mm.size()));
}

inline Mesh noisy(Mesh mesh, double sigma_mm) {
  mesh.normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    mesh.vertices_mm[i] += mesh.normals[i] * static_cast<float>(sigma_mm * normal_from(hash(i)));
  mesh.normals.clear();
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), static_cast<float>(sigma_mm));
  return mesh;
}

}  // namespace frangia::testing
