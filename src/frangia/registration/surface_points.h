#pragma once

#include <vector>

#include <Eigen/Geometry>

namespace frangia {

/// Points of a surface with their normals.
///
/// @units    mm; normals are unit
struct SurfacePoints {
  std::vector<Eigen::Vector3f> points_mm;  ///< positions
  std::vector<Eigen::Vector3f> normals;    ///< one for each point

  [[nodiscard]] std::size_t size() const { return points_mm.size(); }  ///< number of points
  /// Appends a point and its unit normal.
  void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
    points_mm.push_back(point);
    normals.push_back(normal);
  }
  /// Adds all points of another set, moved by `move`.
  void add(const SurfacePoints& other, const Eigen::Isometry3d& move);
};

/// Keeps one point for each occupied cube of `spacing_mm` and each of the six directions that its
/// normal may be nearest to: the point nearest to their mean, with their mean normal.
///
/// @shape    ordered by cube, independent of the order of the points
[[nodiscard]] SurfacePoints voxel_downsample(const SurfacePoints& points, double spacing_mm);

}  // namespace frangia
