#include "frangia/geometry/triangle_predicates.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace frangia {
namespace {

using Eigen::Vector3d;

bool has(const IndexedTriangle& t, std::uint32_t vertex) {
  return std::find(t.vertices.begin(), t.vertices.end(), vertex) != t.vertices.end();
}

/// Whether all unshared corners of `other` lie on one side of the plane of `plane`, beyond the
/// rounding error.
bool separated_by_plane(const IndexedTriangle& plane, const IndexedTriangle& other) {
  const Vector3d& origin = plane.corners_mm[0];
  const Vector3d u = plane.corners_mm[1] - origin;
  const Vector3d v = plane.corners_mm[2] - origin;
  const Vector3d normal = u.cross(v);
  int above = 0;
  int below = 0;
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (has(plane, other.vertices.at(i))) continue;
    const Vector3d way = other.corners_mm.at(i) - origin;
    const double height = normal.dot(way);
    const double rounding = 1e-13 * u.norm() * v.norm() * way.norm();
    ++count;
    if (height > rounding) ++above;
    if (height < -rounding) ++below;
  }
  return count > 0 && (above == count || below == count);
}

/// Whether, projected along the dominant axis of the normal of `a`, all unshared corners of `b` lie
/// beyond one edge of `a`.
bool separated_by_edge(const IndexedTriangle& a, const IndexedTriangle& b) {
  const Vector3d normal =
      (a.corners_mm[1] - a.corners_mm[0]).cross(a.corners_mm[2] - a.corners_mm[0]);
  Eigen::Index dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  const Eigen::Index x = (dropped + 1) % 3;
  const Eigen::Index y = (dropped + 2) % 3;
  const double turn = normal[dropped] > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& from = a.corners_mm.at(i);
    const Vector3d along = a.corners_mm.at((i + 1) % 3) - from;
    const bool shared_from = has(b, a.vertices.at(i));
    const bool shared_to = has(b, a.vertices.at((i + 1) % 3));
    int beyond = 0;
    int count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool on_line = (shared_from && b.vertices.at(k) == a.vertices.at(i)) ||
                           (shared_to && b.vertices.at(k) == a.vertices.at((i + 1) % 3));
      if (on_line) continue;
      const Vector3d way = b.corners_mm.at(k) - from;
      const double side = turn * (along[x] * way[y] - along[y] * way[x]);
      ++count;
      if (side < -1e-13 * along.norm() * way.norm()) ++beyond;
    }
    if (count > 0 && beyond == count) return true;
  }
  return false;
}

}  // namespace

bool surely_disjoint(const IndexedTriangle& a, const IndexedTriangle& b) {
  return separated_by_plane(a, b) || separated_by_plane(b, a) || separated_by_edge(a, b) ||
         separated_by_edge(b, a);
}

}  // namespace frangia
