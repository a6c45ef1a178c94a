#include <algorithm>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/geometry/triangulate_polygon.h"
#include "frangia/mesh/internal/hole_patch.h"
#include "frangia/mesh/internal/minimum_area_triangulation.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using VertexLoop = std::vector<std::uint32_t>;

// Longer boundaries are triangulated in projection, which takes less than the cube of the length.
constexpr std::size_t kMaxByArea = 100;

Vector3d position(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices_mm[vertex].cast<double>();
}

/// The normal of the plane on which the projected area of a polygon is largest.
Vector3d normal_of_polygon(const std::vector<Vector3d>& line) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < line.size(); ++i)
    normal += (line[i] - line.front()).cross(line[(i + 1) % line.size()] - line.front());
  return normal;
}

std::vector<Mesh::Triangle> minimum_area(const std::vector<Vector3d>& line,
                                         const VertexLoop& loop) {
  std::vector<Mesh::Triangle> triangles;
  const MinimumAreaOptions options{.normals = {line.size(), normal_of_polygon(line)},
                                   .is_forbidden = {}};
  for (const auto& [a, b, c] : minimum_area_triangulation(line, options))
    triangles.push_back({loop[a], loop[b], loop[c]});
  return triangles;
}

/// Triangulates the projection of a polygon on its plane; empty when it intersects itself.
std::vector<Mesh::Triangle> triangulate_projection(const std::vector<Vector3d>& line,
                                                   const VertexLoop& loop) {
  const Vector3d normal = normal_of_polygon(line);
  const Vector3d x = normal.unitOrthogonal();
  const Vector3d y = normal.normalized().cross(x);
  Polygon projection;
  for (const Vector3d& corner : line) {
    const Vector3d away = corner - line.front();
    projection.emplace_back(away.dot(x), away.dot(y));
  }
  std::vector<Mesh::Triangle> triangles;
  try {
    for (const auto& [a, b, c] : triangulate_polygon(projection))
      triangles.push_back({loop[a], loop[b], loop[c]});
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Numeric) throw;
    triangles.clear();
  }
  return triangles;
}

}  // namespace

HolePatch flat_patch(const Mesh& mesh, const VertexLoop& boundary) {
  HolePatch patch;
  if (boundary.size() < 3) return patch;
  const VertexLoop loop(boundary.rbegin(),
                        boundary.rend());  // the patch has the opposite direction
  std::vector<Vector3d> line;
  for (const std::uint32_t vertex : loop)
    line.push_back(position(mesh, vertex));
  if (loop.size() > kMaxByArea) patch.triangles = triangulate_projection(line, loop);
  if (patch.triangles.empty()) patch.triangles = minimum_area(line, loop);
  return patch;
}

HolePatch fan_patch(const Mesh& mesh, const std::vector<std::uint32_t>& loop) {
  HolePatch patch;
  Vector3d mean = Vector3d::Zero();
  for (const std::uint32_t vertex : loop)
    mean += position(mesh, vertex);
  patch.positions_mm.emplace_back((mean / static_cast<double>(loop.size())).cast<float>());
  const auto middle = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < loop.size(); ++i)
    patch.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], middle});
  return patch;
}

}  // namespace frangia
