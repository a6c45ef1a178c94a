#include "frangia/files/internal/polygon_triangles.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/geometry/triangulate_polygon.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// Twice the area of a polygon along its normal.
Vector3d newell_normal(std::span<const Vector3d> corners, const Vector3d& mean) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += (corners[i] - mean).cross(corners[(i + 1) % corners.size()] - mean);
  return normal;
}

/// Whether a polygon turns to the left at every corner, and once around in all.
bool is_convex(const Polygon& outline) {
  const std::size_t count = outline.size();
  constexpr double kFlat = 1e-12;  // of the squared size
  double size2 = 0.0;
  for (const Eigen::Vector2d& point : outline)
    size2 = std::max(size2, (point - outline[0]).squaredNorm());
  double turned = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d a = outline[(i + 1) % count] - outline[i];
    const Eigen::Vector2d b = outline[(i + 2) % count] - outline[(i + 1) % count];
    const double turn = a.x() * b.y() - a.y() * b.x();
    if (turn < -kFlat * size2) return false;
    turned += std::atan2(turn, a.dot(b));
  }
  constexpr double kOnce = 6.5;  // of 2 pi; a star turns twice
  return turned < kOnce;
}

std::vector<std::array<std::size_t, 3>> fan_of(std::size_t count) {
  std::vector<std::array<std::size_t, 3>> fan;
  for (std::size_t i = 2; i < count; ++i)
    fan.push_back({0, i - 1, i});
  return fan;
}

}  // namespace

PolygonTriangles polygon_triangles(std::span<const Vector3d> corners) {
  PolygonTriangles found;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& corner : corners)
    mean += corner / static_cast<double>(corners.size());
  const Vector3d normal = newell_normal(corners, mean).normalized();
  if (corners.size() == 3 || !normal.allFinite() || !(normal.norm() > 0.5)) {
    found.triangles = fan_of(corners.size());  // without an area, any triangles are as good
    return found;
  }
  const Vector3d across = normal.unitOrthogonal();
  const Vector3d up = normal.cross(across);
  Polygon outline;
  outline.reserve(corners.size());
  for (const Vector3d& corner : corners) {
    const Vector3d offset = corner - mean;
    outline.emplace_back(offset.dot(across), offset.dot(up));
    found.off_plane = std::max(found.off_plane, std::abs(offset.dot(normal)));
  }
  if (is_convex(outline)) {
    found.triangles = fan_of(corners.size());
    return found;
  }
  try {
    found.triangles = triangulate_polygon(outline);
  } catch (const Error&) {
    found.crosses = true;
    found.triangles = fan_of(corners.size());
  }
  return found;
}

}  // namespace frangia
