#include <algorithm>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/mesh/fill_polygon.h"
#include "frangia/mesh/hole_patch.h"
#include "frangia/mesh/triangulate_polygon.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Rim = std::vector<std::uint32_t>;

constexpr std::size_t kMostByArea = 100;  // of larger rims the shadow is the better guess

Vector3d place(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices_mm[vertex].cast<double>();
}

/// The direction of the plane that fits a line best, by the area of its shadow.
Vector3d direction_of(const std::vector<Vector3d>& line) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < line.size(); ++i)
    normal += (line[i] - line.front()).cross(line[(i + 1) % line.size()] - line.front());
  return normal;
}

std::vector<Mesh::Triangle> least_area(const std::vector<Vector3d>& line, const Rim& rim) {
  std::vector<Mesh::Triangle> triangles;
  const FillPolygonOptions options{.normals = {line.size(), direction_of(line)}, .barred = {}};
  for (const auto& [a, b, c] : fill_polygon(line, options))
    triangles.push_back({rim[a], rim[b], rim[c]});
  return triangles;
}

/// The triangles of the line's shadow on its plane; none when the shadow crosses itself.
std::vector<Mesh::Triangle> by_shadow(const std::vector<Vector3d>& line, const Rim& rim) {
  const Vector3d normal = direction_of(line);
  const Vector3d x = normal.unitOrthogonal();
  const Vector3d y = normal.normalized().cross(x);
  Polygon shadow;
  for (const Vector3d& corner : line) {
    const Vector3d away = corner - line.front();
    shadow.emplace_back(away.dot(x), away.dot(y));
  }
  std::vector<Mesh::Triangle> triangles;
  try {
    for (const auto& [a, b, c] : triangulate_polygon(shadow))
      triangles.push_back({rim[a], rim[b], rim[c]});
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Numeric) throw;
    triangles.clear();
  }
  return triangles;
}

}  // namespace

HolePatch flat_patch(const Mesh& mesh, const Rim& boundary) {
  HolePatch patch;
  if (boundary.size() < 3) return patch;
  const Rim rim(boundary.rbegin(), boundary.rend());  // the patch runs against the boundary
  std::vector<Vector3d> line;
  for (const std::uint32_t vertex : rim)
    line.push_back(place(mesh, vertex));
  if (rim.size() > kMostByArea) patch.triangles = by_shadow(line, rim);
  if (patch.triangles.empty()) patch.triangles = least_area(line, rim);
  return patch;
}

HolePatch fan_patch(const Mesh& mesh, const std::vector<std::uint32_t>& rim) {
  HolePatch patch;
  Vector3d mean = Vector3d::Zero();
  for (const std::uint32_t vertex : rim)
    mean += place(mesh, vertex);
  patch.places_mm.emplace_back((mean / static_cast<double>(rim.size())).cast<float>());
  const auto middle = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < rim.size(); ++i)
    patch.triangles.push_back({rim[(i + 1) % rim.size()], rim[i], middle});
  return patch;
}

}  // namespace frangia
