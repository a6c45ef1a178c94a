#include "frangia/core/rigid_motion.h"

#include <Eigen/SVD>

namespace frangia {

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& spread) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, 1.0);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

Eigen::Isometry3d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Vector3d from_center = from.rowwise().mean();
  const Eigen::Vector3d to_center = to.rowwise().mean();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < from.cols(); ++i)
    spread += (to.col(i) - to_center) * (from.col(i) - from_center).transpose();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = nearest_rotation(spread);
  motion.translation() = to_center - motion.linear() * from_center;
  return motion;
}

}  // namespace frangia
