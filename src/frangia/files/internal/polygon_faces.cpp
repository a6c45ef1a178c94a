#include "frangia/files/internal/polygon_faces.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/geometry/triangulate_polygon.h"

namespace frangia {

void OddFaces::note(const PolygonTriangles& face, double size) {
  constexpr double kPlane = 1e-3;  // of the size of the face: below, formats round as much
  if (face.crosses) ++crossing_;
  if (!(face.off_plane > kPlane * size)) return;
  ++not_plane_;
  largest_ = std::max(largest_, face.off_plane);
}

void OddFaces::warn(const std::filesystem::path& path, double mm_per_unit, const Run& run) const {
  if (without_area_ > 0) {
    run.warn(fmt::format("{}: left out {} triangle{} with two corners at one place",
                         path.string(),
                         without_area_,
                         without_area_ == 1 ? "" : "s"));
  }
  if (not_plane_ > 0) {
    run.warn(fmt::format(
        "{}: {} of its faces with more than three corners {} not plane, by up to {:.3g} mm; their "
        "triangles are those of the projection onto the mean plane",
        path.string(),
        not_plane_,
        not_plane_ == 1 ? "is" : "are",
        mm_per_unit * largest_));
  }
  if (crossing_ > 0) {
    run.warn(fmt::format("{}: the outline of {} face{} crosses itself; export triangles instead",
                         path.string(),
                         crossing_,
                         crossing_ == 1 ? "" : "s"));
  }
}

void PolygonFaces::add(Mesh& mesh, std::span<const std::uint32_t> corners) {
  if (corners.size() > 3)
    fans_.push_back({mesh.triangles.size(), static_cast<std::uint32_t>(corners.size())});
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void PolygonFaces::triangulate(Mesh& mesh,
                               const std::filesystem::path& path,
                               const Run& run) const {
  constexpr std::size_t kPerCheck = 1024;
  constexpr std::uint32_t kMostCorners = 20'000;  // ear clipping takes the square of it
  OddFaces odd;
  std::vector<std::uint32_t> corners;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < fans_.size(); ++i) {
    if (i % kPerCheck == 0) run.check();
    const Fan& fan = fans_[i];
    if (fan.corners > kMostCorners) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: a face has {} corners, more than {}; export triangles instead",
                              path.string(),
                              fan.corners,
                              kMostCorners));
    }
    corners = {mesh.triangles[fan.first][0], mesh.triangles[fan.first][1]};
    for (std::uint32_t k = 0; k + 2 < fan.corners; ++k)
      corners.push_back(mesh.triangles[fan.first + k][2]);
    points.clear();
    Eigen::AlignedBox3d box;
    for (const std::uint32_t corner : corners) {
      points.push_back(mesh.vertices_mm[corner].cast<double>());
      box.extend(points.back());
    }
    const PolygonTriangles found = polygon_triangles(points);
    odd.note(found, box.diagonal().norm());
    for (std::size_t k = 0; k < found.triangles.size(); ++k) {
      const auto& [a, b, c] = found.triangles[k];
      mesh.triangles[fan.first + k] = {corners[a], corners[b], corners[c]};
    }
  }
  odd.warn(path, 1.0, run);
}

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
