#include "frangia/range/match_by_phase.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/camera_phases.h"
#include "frangia/range/internal/phase_sample.h"

namespace frangia {
namespace {

/// The epipolar planes of two cameras. A direction has the angle of its plane about the baseline
/// and its cotangent to the baseline. A point at the distance r from the baseline has cotangents
/// in both cameras that differ by `baseline_mm` / r.
///
/// Unlike rectification to a common image plane, this holds for cameras in any position, one above
/// or behind the other too.
struct EpipolarPlanes {
  /// In the frame of the first camera: along the baseline to the second camera; towards the field;
  /// and perpendicular to both.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: along, forward, across
  double baseline_mm = 0.0;                            ///< distance of the centres

  /// Plane angle, rad, and cotangent of a direction in the frame of the first camera.
  [[nodiscard]] Eigen::Vector2d coordinates_of(const Eigen::Vector3d& direction) const;
};

/// The phase of one camera on the epipolar planes: a row for each plane, a column for each
/// cotangent.
struct EpipolarRows {
  Image<float> phase_rad;    ///< NaN: not measured
  double first_angle = 0.0;  ///< of row 0, rad
  double first_cot = 0.0;    ///< of column 0
  double step = 0.0;         ///< of both, about the angle of a pixel
  float jump_rad = 0.0F;     ///< neighbours that differ by more belong to two surfaces

  /// The row of a plane angle, or null.
  [[nodiscard]] const float* row_at(double angle) const;
};

/// Directions nearer to the baseline have no useful parallax.
constexpr double kMaxCot = 10.0;

Eigen::Vector2d EpipolarPlanes::coordinates_of(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d along = axes * direction;
  return {std::atan2(along.z(), along.y()), along.x() / std::hypot(along.y(), along.z())};
}

/// Returns the epipolar planes of two cameras.
///
/// @errors   Error(Input) when both have the same centre
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

/// Resamples the first direction's phase of a camera on epipolar planes.
///
/// @missing  without rows when no pixel has a phase
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

/// Crossings at fewer columns from each other are one, which noise has split.
constexpr int kSameColumns = 3;

/// Calls `found` with the column of each crossing of a phase within columns [0, end) of a row.
template <typename Found>
void for_each_crossing(
    const float* row, int end, float phase_rad, float jump_rad, const Found& found) {
  int last = -2 * kSameColumns;
  for (int i = 0; i + 1 < end; ++i) {
    const float here = row[i] - phase_rad;
    const float next = row[i + 1] - phase_rad;
    // False for NaN, too.
    if (!((here <= 0.0F && next > 0.0F) || (here > 0.0F && next <= 0.0F))) continue;
    if (!(std::abs(next - here) < jump_rad)) continue;
    if (i - last >= kSameColumns)
      found(static_cast<double>(i) + static_cast<double>(here / (here - next)));
    last = i;
  }
}

/// Whether a phase occurs at one place only of a camera's own epipolar line.
bool is_unique(const EpipolarRows& own, double angle, float phase_rad) {
  const float* row = own.row_at(angle);
  int crossings = 0;
  if (row != nullptr) {
    for_each_crossing(
        row, own.phase_rad.width(), phase_rad, own.jump_rad, [&](double) { ++crossings; });
  }
  return crossings <= 1;
}

class Matcher {
 public:
  Matcher(const CameraPhases& first, const CameraPhases& second)
      : first_(first),
        second_(second),
        second_from_first_(second.camera_from_rig * first.camera_from_rig.inverse()),
        planes_(epipolar_planes(second_from_first_)) {
    for (const AbsolutePhase* phase : second.phases)
      samplers_.emplace_back(*phase);
    const PhaseSampler own(*first.phases.front());
    own_ = epipolar_rows(first, Eigen::Isometry3d::Identity(), planes_, own);
    other_ = epipolar_rows(second, second_from_first_, planes_, samplers_.front());
  }

  /// The depth of a pixel; NaN without a unique match.
  [[nodiscard]] float depth_of(int x, int y) const {
    const float phase_rad = first_.phases.front()->phase_rad(x, y);
    if (std::isnan(phase_rad) || other_.phase_rad.empty()) return kMissing;
    const Eigen::Vector3d ray = first_.rays(x, y).cast<double>().homogeneous();
    const Eigen::Vector2d at = planes_.coordinates_of(ray);
    const float* row = other_.row_at(at.x());
    if (row == nullptr) return kMissing;
    // Points in front of both cameras have a smaller cotangent in the second.
    const double end = std::min((at.y() - other_.first_cot) / other_.step + 1.0,
                                static_cast<double>(other_.phase_rad.width()));
    if (!(end >= 2.0)) return kMissing;
    return samplers_.size() == 1 ? by_one_direction(row, static_cast<int>(end), phase_rad, ray, at)
                                 : by_two_directions(row, static_cast<int>(end), {x, y}, ray, at);
  }

 private:
  /// The depth of the crossing at a column; NaN behind the camera.
  [[nodiscard]] double depth_at(double column, const Eigen::Vector3d& ray, double cot) const {
    const double parallax = cot - (other_.first_cot + column * other_.step);
    const Eigen::Vector3d along = planes_.axes * ray;
    const double depth = planes_.baseline_mm / (parallax * std::hypot(along.y(), along.z()));
    return parallax > 0.0 && (second_from_first_ * (depth * ray)).z() > 0.0
               ? depth
               : std::numeric_limits<double>::quiet_NaN();
  }

  [[nodiscard]] float by_one_direction(const float* row,
                                       int end,
                                       float phase_rad,
                                       const Eigen::Vector3d& ray,
                                       const Eigen::Vector2d& at) const {
    int candidates = 0;
    double depth = std::numeric_limits<double>::quiet_NaN();
    for_each_crossing(row, end, phase_rad, other_.jump_rad, [&](double column) {
      const double found = depth_at(column, ray, at.y());
      if (std::isnan(found)) return;
      depth = found;
      ++candidates;
    });
    const bool unique = candidates == 1 && is_unique(own_, at.x(), phase_rad);
    return unique ? static_cast<float>(depth) : kMissing;
  }

  [[nodiscard]] float by_two_directions(const float* row,
                                        int end,
                                        const Eigen::Vector2i& pixel,
                                        const Eigen::Vector3d& ray,
                                        const Eigen::Vector2d& at) const {
    const float phase_rad = first_.phases.front()->phase_rad(pixel.x(), pixel.y());
    const double across_rad =
        static_cast<double>(first_.phases.back()->phase_rad(pixel.x(), pixel.y()));
    if (std::isnan(across_rad)) return kMissing;
    double best = samplers_.back().jump_rad();
    double depth = std::numeric_limits<double>::quiet_NaN();
    for_each_crossing(row, end, phase_rad, other_.jump_rad, [&](double column) {
      const double found = depth_at(column, ray, at.y());
      if (std::isnan(found)) return;
      const Eigen::Vector3d seen = second_from_first_ * (found * ray);
      const double misfit_rad = std::abs(
          samplers_.back().at(second_.rig.reference().model.project(seen)).phase_rad - across_rad);
      if (!(misfit_rad < best)) return;
      best = misfit_rad;
      depth = found;
    });
    return static_cast<float>(depth);
  }

  const CameraPhases& first_;
  const CameraPhases& second_;
  Eigen::Isometry3d second_from_first_;
  EpipolarPlanes planes_;
  std::vector<PhaseSampler> samplers_;  ///< of the second camera
  EpipolarRows own_;
  EpipolarRows other_;
};

}  // namespace

Image<float> match_by_phase(const CameraPhases& first, const CameraPhases& second, const Run& run) {
  require(!first.phases.empty() && first.phases.size() == second.phases.size(),
          "match_by_phase: the cameras differ in the directions of their fringes");
  const Matcher matcher(first, second);
  Image<float> depth_mm(first.rays.width(), first.rays.height(), kMissing);
  parallel_rows(depth_mm.height(), [&](int y) {
    if (run.stop.stop_requested()) return;
    for (int x = 0; x < depth_mm.width(); ++x)
      depth_mm(x, y) = matcher.depth_of(x, y);
  });
  run.check();
  return depth_mm;
}

}  // namespace frangia
