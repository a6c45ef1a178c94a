#pragma once

#include <vector>

#include <Eigen/Geometry>

namespace frangia {

/// Points of a surface and where it faces there. units mm; normals are unit
struct SurfacePoints {
  std::vector<Eigen::Vector3f> points_mm;
  std::vector<Eigen::Vector3f> normals;

  [[nodiscard]] std::size_t size() const { return points_mm.size(); }
  void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
    points_mm.push_back(point);
    normals.push_back(normal);
  }
  /// Adds all points of another set, moved.
  void add(const SurfacePoints& other, const Eigen::Isometry3d& move);
};

/// About one point for each cube of `spacing_mm` and each of the six ways that a surface in it may
/// face: the one nearest to their mean, with their mean normal.
///
/// shape    in the order of the cubes, which does not depend on the order of the points
[[nodiscard]] SurfacePoints voxel_downsample(const SurfacePoints& points, double spacing_mm);

}  // namespace frangia
