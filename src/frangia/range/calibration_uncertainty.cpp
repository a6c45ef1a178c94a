#include "frangia/range/calibration_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/internal/changed_rigs.h"
#include "frangia/range/internal/node_values.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
CalibrationUncertainty::CalibrationUncertainty(const Rig& rig,
                                               const Pattern& pattern,
                                               std::span<const Eigen::Vector3d> volume_mm,
                                               std::size_t camera) {
  if (!rig.calibration || rig.calibration->covariance.empty() || volume_mm.empty()) return;
  const ChangedRigs rigs(rig, pattern, camera);
  if (rigs.changes() == 0) return;
  const RigidMotions rigid = fit_rigid(volume_mm, rigs);
  const Eigen::Isometry3d rig_from_camera = rig.cameras[camera].camera_from_rig().inverse();
  const CameraModel& model = rig.cameras[camera].camera.model;
  low_.setConstant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low_;
  for (const Eigen::Vector3d& in_rig : volume_mm) {
    const Eigen::Vector3d point = rig_from_camera.inverse() * in_rig;
    const Eigen::Vector2d pixel = model.project(point);
    const Eigen::Array3d at(pixel.x(), pixel.y(), point.z());
    low_ = low_.min(at);
    high = high.max(at);
  }
  constexpr double kLeastStep = 1e-9;  // px or mm; keeps the step of a flat volume above zero
  step_ = ((high - low_) / (node_counts() - 1.0)).max(kLeastStep);
  constexpr int kCount = kNodes[0] * kNodes[1] * kNodes[2];
  Eigen::MatrixXd nodes(rigs.changes(), kCount);
  parallel_chunks(kCount, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto index = static_cast<int>(i);
      const Eigen::Array3i place(
          index % kNodes[0], index / kNodes[0] % kNodes[1], index / (kNodes[0] * kNodes[1]));
      const Eigen::Array3d at = low_ + step_ * place.cast<double>();
      const Eigen::Vector3d in_camera = at.z() * model.ray({at.x(), at.y()}).homogeneous();
      const Eigen::Vector3d point = rig_from_camera * in_camera;
      const Eigen::Vector3d ray = rig_from_camera.linear() * in_camera;
      const Displacements rest = rigs.displacements_of(point) - rigid.design(point) * rigid.motions;
      nodes.col(index) = rest.transpose() * ray.normalized();
    }
  });
  fill_missing(nodes, kNodes);
  along_ray_mm_ = principal_components(nodes);
}

Eigen::Array3d CalibrationUncertainty::place_of(double x_px, double y_px, double depth_mm) const {
  return ((Eigen::Array3d(x_px, y_px, depth_mm) - low_) / step_).max(0.0).min(node_counts() - 1.0);
}

double CalibrationUncertainty::along_ray_mm(double x_px, double y_px, double depth_mm) const {
  if (along_ray_mm_.size() == 0) return 0.0;
  const Eigen::Array3d place = place_of(x_px, y_px, depth_mm);
  const Eigen::Array3d first = place.floor().min(node_counts() - 2.0);
  const Eigen::Array3d along = place - first;
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(along_ray_mm_.rows());
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3d upper(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const Eigen::Array3i at = (first + upper).cast<int>();
    const double share = (upper * along + (1.0 - upper) * (1.0 - along)).prod();
    sum += static_cast<float>(share) * along_ray_mm_.col(node(at.x(), at.y(), at.z()));
  }
  return static_cast<double>(sum.norm());
}

void CalibrationUncertainty::add_to(RangeGrid& range) const {
  if (along_ray_mm_.size() == 0) return;
  const int width = range.depth_mm.width();
  range.differing_share = 0.0F;  // the rig is that of all views
  if (range.systematic_mm.empty()) {
    range.systematic_mm = Image<float>(width, range.depth_mm.height(), Uninitialized{});
    parallel_rows(range.depth_mm.height(), [&](int y) {
      for (int x = 0; x < width; ++x)
        range.systematic_mm(x, y) = std::isnan(range.depth_mm(x, y)) ? kMissing : 0.0F;
    });
  }
  const Eigen::Index components = along_ray_mm_.rows();
  parallel_rows(range.depth_mm.height(), [&](int y) {
    const double row = place_of(0.0, y, 0.0).y();
    const int upper = std::min(static_cast<int>(row), kNodes[1] - 2);
    const auto down = static_cast<float>(row - upper);
    // The nodes interpolated at this row, with those along depth side by side.
    Eigen::MatrixXf nodes(components, kNodes[0] * kNodes[2]);
    for (int z = 0; z < kNodes[2]; ++z) {
      for (int x = 0; x < kNodes[0]; ++x) {
        nodes.col(x * kNodes[2] + z) = (1.0F - down) * along_ray_mm_.col(node(x, upper, z)) +
                                       down * along_ray_mm_.col(node(x, upper + 1, z));
      }
    }
    for (int x = 0; x < width; ++x) {
      const float depth = range.depth_mm(x, y);
      if (std::isnan(depth)) continue;
      const Eigen::Array3d place = place_of(x, y, static_cast<double>(depth));
      const int left = std::min(static_cast<int>(place.x()), kNodes[0] - 2);
      const int near = std::min(static_cast<int>(place.z()), kNodes[2] - 2);
      const auto right = static_cast<float>(place.x() - left);
      const auto far = static_cast<float>(place.z() - near);
      const float* front = &nodes(0, left * kNodes[2] + near);
      const float* back = front + kNodes[2] * components;
      float squares = 0.0F;
      for (Eigen::Index i = 0; i < components; ++i) {
        const float here = front[i] + far * (front[i + components] - front[i]);
        const float next = back[i] + far * (back[i + components] - back[i]);
        const float moved = here + right * (next - here);
        squares += moved * moved;
      }
      float& systematic = range.systematic_mm(x, y);
      systematic = combined_sigma(systematic, std::sqrt(squares));
    }
  });
}

}  // namespace frangia
