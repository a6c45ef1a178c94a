#include "frangia/range/rig_change_field.h"

#include <algorithm>
#include <limits>

#include "frangia/core/parallel.h"
#include "frangia/range/internal/changed_rigs.h"
#include "frangia/range/internal/phase_sample.h"

namespace frangia {
namespace {

Eigen::Array3d grid_place(const Rig& rig, const Eigen::Vector3d& point_mm) {
  const Eigen::Vector2d pixel = rig.reference().model.project(point_mm);
  return {pixel.x(), pixel.y(), point_mm.z()};
}

}  // namespace

RigChangeField::RigChangeField(const Rig& rig, const Pattern& pattern, const MeasuredVolume& volume)
    : rig_(rig) {
  if (!rig.calibration || rig.calibration->covariance.empty() || volume.points_mm.empty()) return;
  const ChangedRigs rigs(rig, pattern);
  if (rigs.changes() == 0) return;
  const RigidMotions rigid = fit_rigid(volume, rigs);
  low_.setConstant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low_;
  for (const Eigen::Vector3d& point : volume.points_mm) {
    const Eigen::Array3d at = grid_place(rig, point);
    low_ = low_.min(at);
    high = high.max(at);
  }
  constexpr double kLeastStep = 1e-9;  // px or mm; keeps the step of a flat volume above zero
  const Eigen::Array3d counts(kNodes[0], kNodes[1], kNodes[2]);
  step_ = ((high - low_) / (counts - 1.0)).max(kLeastStep);
  constexpr Eigen::Index kCount = kNodes[0] * kNodes[1] * kNodes[2];
  const Eigen::Index changes = rigs.changes();
  Eigen::MatrixXd nodes(3 * changes, kCount);
  parallel_chunks(kCount, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto index = static_cast<int>(i);
      const Eigen::Array3d at = low_ + step_ * Eigen::Array3d(index % kNodes[0],
                                                              index / kNodes[0] % kNodes[1],
                                                              index / (kNodes[0] * kNodes[1]));
      const Eigen::Vector3d point =
          at.z() * Eigen::Vector3d(rig.reference().model.ray({at.x(), at.y()}).homogeneous());
      const Displacements rest = rigs.displacements_of(point) - rigid.design(point) * rigid.motions;
      nodes.col(index) = rest.reshaped();
    }
  });
  fill_missing(nodes, kNodes);
  values_ = principal_displacements(nodes);
  components_ = values_.rows();
}

Eigen::Matrix3Xf RigChangeField::at(const Eigen::Vector3d& point_mm) const {
  Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(components_, 3);
  if (components_ == 0) return sum.transpose();
  const Eigen::Array3d last(kNodes[0] - 1, kNodes[1] - 1, kNodes[2] - 1);
  const Eigen::Array3d place = ((grid_place(rig_, point_mm) - low_) / step_).max(0.0).min(last);
  const Eigen::Array3d first = place.floor().min(last - 1.0);
  const Eigen::Array3d along = place - first;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3d upper(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const Eigen::Array3i node = (first + upper).cast<int>();
    const double share = (upper * along + (1.0 - upper) * (1.0 - along)).prod();
    const Eigen::Index index = (node.z() * kNodes[1] + node.y()) * kNodes[0] + node.x();
    sum += static_cast<float>(share) * values_.middleCols(3 * index, 3);
  }
  return sum.transpose();
}

}  // namespace frangia
