#include "frangia/inspect/internal/vertex_use.h"

#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {

std::vector<std::uint8_t> boundary_flags(const Mesh& mesh) {
  std::vector<std::uint8_t> flags(mesh.vertices_mm.size(), 0);
  const HalfEdges edges(mesh);
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (!edges.is_boundary(edge)) continue;
    const auto& triangle = mesh.triangles[edge / 3];
    flags[triangle.at(edge % 3)] = 1;
    flags[triangle.at((edge + 1) % 3)] = 1;
  }
  return flags;
}

std::vector<VertexUse> vertex_uses(const Mesh& mesh) {
  std::vector<VertexUse> status(mesh.vertices_mm.size(), VertexUse::Unused);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool synthesized = mark_of(mesh, t) == Mark::Synthesized;
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (!synthesized) status[v] = VertexUse::Measured;
      if (synthesized && status[v] == VertexUse::Unused) status[v] = VertexUse::Synthesized;
    }
  }
  const auto boundary = boundary_flags(mesh);
  for (std::size_t i = 0; i < status.size(); ++i) {
    if (status[i] == VertexUse::Unused) continue;
    if (!mesh.vertex_marks.empty() && mesh.vertex_marks[i] == Mark::Synthesized)
      status[i] = VertexUse::Synthesized;
    if (status[i] == VertexUse::Measured && boundary[i] != 0) status[i] = VertexUse::MeshEdge;
    if (!mesh.vertices_mm[i].allFinite()) status[i] = VertexUse::Unused;
  }
  return status;
}

std::vector<std::uint8_t> sharp_edge_flags(const Mesh& mesh,
                                           const std::vector<Eigen::Vector3f>& normals,
                                           double max_rad) {
  std::vector<std::uint8_t> flags(mesh.vertices_mm.size(), 0);
  const double least = std::cos(max_rad);
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_mm[triangle[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices_mm[triangle[1]].cast<double>();
    const Eigen::Vector3d c = mesh.vertices_mm[triangle[2]].cast<double>();
    const Eigen::Vector3d facing = (b - a).cross(c - a).normalized();
    for (const std::uint32_t v : triangle)
      if (normals[v].cast<double>().dot(facing) < least) flags[v] = 1;
  }
  return flags;
}

std::vector<double> vertex_areas(const Mesh& mesh) {
  std::vector<double> areas(mesh.vertices_mm.size(), 0.0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices_mm[a].cast<double>();
    const Eigen::Vector3d ab = mesh.vertices_mm[b].cast<double>() - p;
    const Eigen::Vector3d ac = mesh.vertices_mm[c].cast<double>() - p;
    const double third = ab.cross(ac).norm() / 6.0;
    if (!std::isfinite(third)) continue;
    areas[a] += third;
    areas[b] += third;
    areas[c] += third;
  }
  return areas;
}

}  // namespace frangia
