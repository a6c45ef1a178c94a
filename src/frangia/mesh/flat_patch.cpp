#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/mesh/hole_patch.h"
#include "frangia/mesh/triangulate_polygon.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostByArea = 120;  // the search takes the cube of it

Vector3d place(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices_mm[vertex].cast<double>();
}

/// Least areas of the pieces between corners i and j of the rim, and the corner that splits them.
struct Pieces {
  std::size_t count;
  std::vector<double> areas;
  std::vector<std::size_t> splits;

  explicit Pieces(std::size_t corners)
      : count(corners), areas(corners * corners, 0.0), splits(corners * corners, 0) {}
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i * count + j; }
};

void collect(const Pieces& pieces,
             const std::vector<std::uint32_t>& rim,
             std::size_t i,
             std::size_t j,
             std::vector<Mesh::Triangle>& triangles) {
  if (j < i + 2) return;
  const std::size_t k = pieces.splits[pieces.at(i, j)];
  triangles.push_back({rim[j], rim[k], rim[i]});  // against the rim's own way round
  collect(pieces, rim, i, k, triangles);
  collect(pieces, rim, k, j, triangles);
}

/// source  Barequet & Sharir 1995, Filling Gaps in the Boundary of a Polyhedron
std::vector<Mesh::Triangle> least_area(const Mesh& mesh, const std::vector<std::uint32_t>& rim) {
  Pieces pieces(rim.size());
  for (std::size_t width = 2; width < rim.size(); ++width) {
    for (std::size_t i = 0; i + width < rim.size(); ++i) {
      const std::size_t j = i + width;
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t k = i + 1; k < j; ++k) {
        const Vector3d a = place(mesh, rim[i]);
        const double own = (place(mesh, rim[k]) - a).cross(place(mesh, rim[j]) - a).norm();
        const double area = pieces.areas[pieces.at(i, k)] + pieces.areas[pieces.at(k, j)] + own;
        if (area >= best) continue;
        best = area;
        pieces.splits[pieces.at(i, j)] = k;
      }
      pieces.areas[pieces.at(i, j)] = best;
    }
  }
  std::vector<Mesh::Triangle> triangles;
  collect(pieces, rim, 0, rim.size() - 1, triangles);
  return triangles;
}

std::vector<Mesh::Triangle> by_shadow(const Mesh& mesh, std::vector<std::uint32_t> rim) {
  std::reverse(rim.begin(), rim.end());  // the patch runs against the rim
  Vector3d normal = Vector3d::Zero();
  const Vector3d origin = place(mesh, rim.front());
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vector3d next = place(mesh, rim[(i + 1) % rim.size()]) - origin;
    normal += (place(mesh, rim[i]) - origin).cross(next);
  }
  const Vector3d x = normal.unitOrthogonal();
  const Vector3d y = normal.normalized().cross(x);
  Polygon shadow;
  for (const std::uint32_t vertex : rim) {
    const Vector3d away = place(mesh, vertex) - origin;
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

HolePatch flat_patch(const Mesh& mesh, const std::vector<std::uint32_t>& rim) {
  HolePatch patch;
  if (rim.size() < 3) return patch;
  patch.triangles = rim.size() <= kMostByArea ? least_area(mesh, rim) : by_shadow(mesh, rim);
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
