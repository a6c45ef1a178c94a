#include "frangia/range/internal/common_point.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/range/triangulate.h"

namespace frangia {
namespace {

constexpr double kNoDepth = static_cast<double>(kMissing);

/// Relative step of numerical derivatives with respect to depth.
constexpr double kRelativeStep = 1e-5;

/// Sums of weighted observations of one direction of fringes, which share a systematic error.
struct DirectionSums {
  double weight = 0.0;
  double weight_slope = 0.0;
  double weight_rad = 0.0;
  double slope_slope = 0.0;
  double slope_rad = 0.0;
  double shared_rad = 0.0;  ///< the largest systematic part
};

/// The share of a sine with a phase step per pixel that interpolation loses: the root mean square
/// over a pixel, whose middle loses most.
double interpolation_loss(double step_rad, bool is_cubic) {
  if (step_rad >= kPi) return 1.0;
  const double kept = is_cubic ? (9.0 * std::cos(0.5 * step_rad) - std::cos(1.5 * step_rad)) / 8.0
                               : std::cos(0.5 * step_rad);
  constexpr double kMeanOfLargest = 0.73;  // of a loss that rises as f (1 - f)
  return kMeanOfLargest * std::clamp(1.0 - kept, 0.0, 1.0);
}

}  // namespace

CommonPoint::CommonPoint(std::span<const CameraPhases> cameras,
                         std::span<const std::vector<PhaseSampler>> samplers,
                         std::size_t own)
    : cameras_(cameras),
      samplers_(samplers),
      own_(own),
      is_label_(cameras[own].rig.projector.is_label) {
  for (const CameraPhases& camera : cameras)
    other_from_own_.push_back(camera.camera_from_rig * cameras[own].camera_from_rig.inverse());
}

Eigen::Vector2d CommonPoint::pixel_of(std::size_t other,
                                      const Eigen::Vector3d& ray,
                                      double depth_mm) const {
  const Eigen::Vector3d point = other_from_own_[other] * (depth_mm * ray);
  if (!(point.z() > 0.0)) return Eigen::Vector2d::Constant(kNoDepth);
  return cameras_[other].rig.reference().model.project(point);
}

OtherSight CommonPoint::sight(std::size_t other,
                              const Eigen::Vector3d& ray,
                              double depth_mm) const {
  OtherSight out;
  const CameraModel& model = cameras_[other].rig.reference().model;
  out.point = other_from_own_[other] * (depth_mm * ray);
  if (!(out.point.z() > 0.0)) return out;
  out.pixel = model.project(out.point);
  const double step_mm = kRelativeStep * depth_mm;
  const Eigen::Vector3d farther = out.point + step_mm * (other_from_own_[other].linear() * ray);
  out.px_per_mm = (model.project(farther) - out.pixel) / step_mm;
  out.visible = true;
  for (std::size_t i = 0; i < samplers_[other].size(); ++i) {
    out.phases[i] = samplers_[other][i].at(out.pixel);
    out.visible = out.visible && !std::isnan(out.phases[i].phase_rad);
  }
  return out;
}

CommonPoint::Shown CommonPoint::shown(std::size_t direction,
                                      const Eigen::Vector3d& ray,
                                      double depth_mm) const {
  if (is_label_) return {};
  const Pattern& pattern = cameras_[own_].phases[direction]->pattern;
  const Projector& projector = cameras_[own_].rig.projector;
  const double step_mm = kRelativeStep * depth_mm;
  const double here = phase_at(depth_mm * ray, pattern, projector);
  return {here, (phase_at((depth_mm + step_mm) * ray, pattern, projector) - here) / step_mm};
}

CommonPoint::Observation CommonPoint::own_phase(int x,
                                                int y,
                                                std::size_t direction,
                                                const Shown& shown) const {
  const AbsolutePhase& phase = *cameras_[own_].phases[direction];
  return {static_cast<double>(phase.phase_rad(x, y)) - shown.rad,
          -shown.rad_per_mm,
          static_cast<double>(phase.sigma_rad(x, y)),
          phase.systematic_rad.empty() ? 0.0 : static_cast<double>(phase.systematic_rad(x, y)),
          0.0};
}

CommonPoint::Observation CommonPoint::other_phase(const OtherSight& seen,
                                                  std::size_t direction,
                                                  const Shown& shown) const {
  const PhaseSample& sample = seen.phases[direction];
  // Harmonics leave an error of as many periods in a fringe as there are shifts.
  const auto shifts =
      static_cast<double>(cameras_[own_].phases[direction]->pattern.shifts_rad.size());
  const double step_rad = shifts * sample.rad_per_px.norm();
  return {sample.phase_rad - shown.rad,
          sample.rad_per_px.dot(seen.px_per_mm) - shown.rad_per_mm,
          sample.sigma_rad,
          sample.systematic_rad,
          interpolation_loss(step_rad, sample.is_cubic)};
}

DepthDifference CommonPoint::compare(int x, int y, double depth_mm, const OtherSight& seen) const {
  if (!seen.visible) return {kNoDepth, kNoDepth, kNoDepth};
  if (is_label_) return compare_rays(x, y, seen);
  const Eigen::Vector3d ray = cameras_[own_].rays(x, y).cast<double>().homogeneous();
  // The depth from the phases of either camera and the projector.
  double own_weight = 0.0;
  double own_sum = 0.0;
  double other_weight = 0.0;
  double other_sum = 0.0;
  double systematic = 0.0;
  for (std::size_t i = 0; i < cameras_[own_].phases.size(); ++i) {
    const Shown projector = shown(i, ray, depth_mm);
    const Observation own = own_phase(x, y, i, projector);
    const Observation other = other_phase(seen, i, projector);
    const double own_information = std::pow(own.rad_per_mm / own.sigma_rad, 2);
    const double other_information = std::pow(other.rad_per_mm / other.sigma_rad, 2);
    if (!std::isnan(own_information)) {
      own_weight += own_information;
      own_sum -= own_information * own.rad / own.rad_per_mm;
    }
    other_weight += other_information;
    other_sum -= other_information * other.rad / other.rad_per_mm;
    const double apart = std::max(own.systematic_rad, other.systematic_rad) *
                         (1.0 / own.rad_per_mm - 1.0 / other.rad_per_mm);
    if (!std::isnan(apart)) systematic = std::max(systematic, std::abs(apart));
  }
  const double along_ray = ray.norm();
  return {along_ray * (other_sum / other_weight - own_sum / own_weight),
          along_ray * std::sqrt(1.0 / own_weight + 1.0 / other_weight),
          along_ray * systematic};
}

DepthDifference CommonPoint::compare_rays(int x, int y, const OtherSight& seen) const {
  constexpr std::size_t kTwo = 2;
  if (cameras_[own_].phases.size() != kTwo) return {kNoDepth, kNoDepth, kNoDepth};
  // The pixel of the other camera that has both phases, relative to the epipolar line.
  const Observation first = own_phase(x, y, 0, {});
  const Observation second = own_phase(x, y, 1, {});
  Eigen::Matrix2d gradients;
  gradients << seen.phases[0].rad_per_px.transpose(), seen.phases[1].rad_per_px.transpose();
  if (!(std::abs(gradients.determinant()) > 0.0)) return {kNoDepth, kNoDepth, kNoDepth};
  const Eigen::Matrix2d px_per_rad = gradients.inverse();
  const Eigen::Vector2d off_px =
      px_per_rad *
      Eigen::Vector2d(first.rad - seen.phases[0].phase_rad, second.rad - seen.phases[1].phase_rad);
  const Eigen::Vector2d along = seen.px_per_mm.normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Vector2d px_of_phases = px_per_rad.transpose() * across;
  const Eigen::Vector2d sigma_rad(std::hypot(first.sigma_rad, seen.phases[0].sigma_rad),
                                  std::hypot(second.sigma_rad, seen.phases[1].sigma_rad));
  const double mm_per_px = seen.point.z() / cameras_[own_].rig.reference().model.focal_px.mean();
  return {
      mm_per_px * across.dot(off_px), mm_per_px * px_of_phases.cwiseProduct(sigma_rad).norm(), 0.0};
}

CommonDepth CommonPoint::solve(int x,
                               int y,
                               double start_mm,
                               std::span<const std::size_t> others,
                               std::span<const double> px_per_px) const {
  constexpr int kIterations = 12;
  constexpr double kConverged = 0.02;  // of sigma; gradients are smoothed
  const CommonDepth none{kNoDepth, kNoDepth, kNoDepth};
  const Eigen::Vector3d ray = cameras_[own_].rays(x, y).cast<double>().homogeneous();
  const std::size_t directions = cameras_[own_].phases.size();
  double depth = start_mm;
  std::vector<Observation> all;
  std::vector<OtherSight> sights;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    sights.clear();
    for (const std::size_t other : others) {
      sights.push_back(sight(other, ray, depth));
      if (!sights.back().visible) return none;
    }
    double information = 0.0;
    double sum = 0.0;
    std::array<DirectionSums, 2> sums;
    all.clear();
    for (std::size_t i = 0; i < directions; ++i) {
      const Shown projector = shown(i, ray, depth);
      DirectionSums& total = sums[i];
      const auto add = [&](const Observation& seen) {
        all.push_back(seen);
        if (std::isnan(seen.rad)) return;
        const double weight = 1.0 / (seen.sigma_rad * seen.sigma_rad);
        total.weight += weight;
        total.weight_slope += weight * seen.rad_per_mm;
        total.weight_rad += weight * seen.rad;
        total.slope_slope += weight * seen.rad_per_mm * seen.rad_per_mm;
        total.slope_rad += weight * seen.rad_per_mm * seen.rad;
        total.shared_rad = std::max(total.shared_rad, seen.systematic_rad);
      };
      add(own_phase(x, y, i, projector));
      for (std::size_t k = 0; k < others.size(); ++k) {
        Observation seen = other_phase(sights[k], i, projector);
        // Fewer pixels than the own camera has there: their noise is common to several of these.
        seen.sigma_rad *= std::max(1.0, 1.0 / px_per_px[k]);
        add(seen);
      }
      // The shared error is a parameter with a standard deviation; without bound for a label.
      const double prior = is_label_                ? 0.0
                           : total.shared_rad > 0.0 ? 1.0 / (total.shared_rad * total.shared_rad)
                                                    : -1.0;
      if (prior < 0.0) {
        total.weight = 0.0;  // there is no shared error
      } else {
        total.weight += prior;
        total.slope_slope -= total.weight_slope * total.weight_slope / total.weight;
        total.slope_rad -= total.weight_slope * total.weight_rad / total.weight;
      }
      information += total.slope_slope;
      sum += total.slope_rad;
    }
    if (!(information > 0.0)) return none;
    const double step = -sum / information;
    depth += step;
    if (!(depth > 0.0)) return none;
    const double sigma = 1.0 / std::sqrt(information);
    if (std::abs(step) > kConverged * sigma) continue;
    // How each phase moves the depth: noise alone, then the shared error.
    double variance = 0.0;
    double systematic2 = 0.0;
    const std::size_t per_direction = 1 + others.size();
    for (std::size_t i = 0; i < directions; ++i) {
      const DirectionSums& total = sums[i];
      double shared = 0.0;
      for (std::size_t k = 0; k < per_direction; ++k) {
        const Observation& seen = all[i * per_direction + k];
        if (std::isnan(seen.rad)) continue;
        const double common = total.weight > 0.0 ? total.weight_slope / total.weight : 0.0;
        const double moved =
            (seen.rad_per_mm - common) / (seen.sigma_rad * seen.sigma_rad * information);
        variance += std::pow(moved * seen.sigma_rad, 2);
        shared += moved;
        systematic2 += std::pow(moved * seen.uncancelled * seen.systematic_rad, 2);
      }
      systematic2 += std::pow(shared * total.shared_rad, 2);
    }
    return {depth, std::sqrt(variance), std::sqrt(systematic2)};
  }
  return none;
}

}  // namespace frangia
