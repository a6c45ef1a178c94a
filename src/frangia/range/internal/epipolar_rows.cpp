#include "frangia/range/internal/epipolar_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Directions nearer to the baseline have no useful parallax.
constexpr double kMaxCot = 10.0;

}  // namespace

Eigen::Vector2d EpipolarPlanes::coordinates_of(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d along = axes * direction;
  return {std::atan2(along.z(), along.y()), along.x() / std::hypot(along.y(), along.z())};
}

EpipolarPlanes epipolar_planes(const Eigen::Isometry3d& second_from_first) {
  EpipolarPlanes out;
  const Eigen::Vector3d center = second_from_first.inverse().translation();
  out.baseline_mm = center.norm();
  require(out.baseline_mm > 0.0, "two cameras have the same centre; correct their positions");
  const Eigen::Vector3d along = center / out.baseline_mm;
  const Eigen::Vector3d middle =
      Eigen::Vector3d::UnitZ() + second_from_first.linear().row(2).transpose();
  Eigen::Vector3d forward = middle - along * along.dot(middle);
  constexpr double kLeast = 1e-6;
  forward =
      forward.norm() > kLeast ? Eigen::Vector3d(forward.normalized()) : along.unitOrthogonal();
  out.axes << along.transpose(), forward.transpose(), along.cross(forward).transpose();
  return out;
}

const float* EpipolarRows::row_at(double angle) const {
  const double row = std::round((angle - first_angle) / step);
  return row >= 0.0 && row < phase_rad.height() ? &phase_rad(0, static_cast<int>(row)) : nullptr;
}

EpipolarRows epipolar_rows(const CameraPhases& camera,
                           const Eigen::Isometry3d& camera_from_first,
                           const EpipolarPlanes& planes,
                           const PhaseSampler& sampler) {
  const CameraModel& model = camera.rig.reference().model;
  const Eigen::Matrix3d camera_from_planes = camera_from_first.linear() * planes.axes.transpose();
  const Image<float>& phase = camera.phases.front()->phase_rad;
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
  for (int y = 0; y < phase.height(); ++y) {
    for (int x = 0; x < phase.width(); ++x) {
      if (std::isnan(phase(x, y))) continue;
      const Eigen::Vector3d ray = camera.rays(x, y).cast<double>().homogeneous();
      const Eigen::Array2d at =
          planes.coordinates_of(camera_from_first.linear().transpose() * ray).array();
      if (!(std::abs(at.y()) < kMaxCot)) continue;
      low = low.min(at);
      high = high.max(at);
    }
  }
  EpipolarRows out;
  if (!(low.x() <= high.x())) return out;
  // A side of the map has at most as many steps as four of the image's longer sides.
  const double longer = std::max(model.width_px, model.height_px);
  out.step = std::max(1.0 / model.focal_px.maxCoeff(), (high - low).maxCoeff() / (4.0 * longer));
  out.first_angle = low.x();
  out.first_cot = low.y();
  out.jump_rad = static_cast<float>(sampler.jump_rad());
  const auto steps = [&](int i) { return static_cast<int>((high[i] - low[i]) / out.step) + 2; };
  out.phase_rad = Image<float>(steps(1), steps(0), kMissing);
  parallel_rows(out.phase_rad.height(), [&](int row) {
    const double angle = out.first_angle + row * out.step;
    for (int column = 0; column < out.phase_rad.width(); ++column) {
      const Eigen::Vector3d direction(
          out.first_cot + column * out.step, std::cos(angle), std::sin(angle));
      const Eigen::Vector3d seen = camera_from_planes * direction;
      if (!(seen.z() > 0.0)) continue;
      out.phase_rad(column, row) = static_cast<float>(sampler.at(model.project(seen)).phase_rad);
    }
  });
  return out;
}

}  // namespace frangia
