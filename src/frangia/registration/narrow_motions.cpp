#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/linear_algebra.h"
#include "frangia/registration/view_motions.h"

namespace frangia {

void narrow_motions(ViewMotions& motions,
                    std::size_t view,
                    const Eigen::Matrix<double, 6, 1>& known,
                    std::span<const Eigen::Vector3f> points_mm) {
  // Sum of the products of the ways of the points by two motions.
  Eigen::Matrix<double, 6, 6> ways = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Eigen::Vector3f& point : points_mm) {
    Eigen::Matrix<double, 3, 6> by;
    for (int axis = 0; axis < 3; ++axis)
      by.col(axis) = Eigen::Vector3d::Unit(axis).cross(point.cast<double>());
    by.rightCols<3>().setIdentity();
    ways += by.transpose() * by;
  }
  const double squares = known.dot(ways * known);
  if (motions.size() < 2 || !(squares > 0.0)) return;
  const double others = static_cast<double>(motions.size()) - 1.0;
  Eigen::Matrix<double, 6, Eigen::Dynamic> apart = (1.0 + 1.0 / others) * motions[view];
  for (const auto& motion : motions)
    apart -= motion / others;
  // In standard deviations of what is known, by each of the independent changes.
  const Eigen::VectorXd along = (known.transpose() * ways * apart).transpose() / squares;
  const double variance = along.squaredNorm();
  if (!(variance > 0.0)) return;
  // The square of I - s a a^T is I - a a^T / (1 + a^T a), the covariance after an observation.
  const double share = (1.0 - 1.0 / std::sqrt(1.0 + variance)) / variance;
  for (auto& motion : motions)
    motion -= share * product(motion, along) * along.transpose();
}

}  // namespace frangia
