#include "frangia/geometry/fit_plane.h"

#include "frangia/core/symmetric_eigen.h"

namespace frangia {

Eigen::Hyperplane<double, 3> fit_plane(std::span<const Eigen::Vector3d> points_mm) {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points_mm)
    centroid += point / static_cast<double>(points_mm.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points_mm)
    scatter += (point - centroid) * (point - centroid).transpose();
  return {Eigen::Vector3d(symmetric_eigen(scatter).vectors.col(0)), centroid};
}

}  // namespace frangia
