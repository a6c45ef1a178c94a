#include "frangia/calibrate/check/internal/check_limits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/statistics.h"
#include "frangia/range/calibration_uncertainty.h"

namespace frangia {

CheckLimits::CheckLimits(const CheckedCamera& camera,
                         const std::vector<Eigen::Vector3d>& points,
                         const CheckRigOptions& options,
                         RigCheck check)
    : options_(options), check_(std::move(check)) {
  const Rig& rig = camera.whole;
  if (camera.camera > 0)
    suffix_ = fmt::format(", camera {}", rig.cameras.at(camera.camera).camera.name);
  for (const Eigen::Vector3d& point : points)
    distance_mm_ += point.norm() / static_cast<double>(points.size());
  if (camera.camera == 0) check_.distance_mm = distance_mm_;
  if (!rig.calibration || rig.calibration->covariance.empty()) return;
  Pattern pattern;
  (rig.projector.is_angular() ? pattern.fringes_per_degree : pattern.period_px) = 1.0;
  const Eigen::Isometry3d rig_from_camera = rig.cameras[camera.camera].camera_from_rig().inverse();
  std::vector<Eigen::Vector3d> own;  // in the frame of the camera
  MeasuredVolume volume;
  constexpr std::size_t kMost = 500;
  for (std::size_t i = 0; i < points.size(); i += points.size() / kMost + 1) {
    own.push_back(points[i]);
    volume.points_mm.emplace_back(rig_from_camera * points[i]);
  }
  const CalibrationUncertainty uncertainty(rig, pattern, volume, camera.camera);
  const CameraModel& model = rig.cameras[camera.camera].camera.model;
  double square = 0.0;
  for (const Eigen::Vector3d& point : own) {
    square += std::pow(uncertainty.along_ray_mm(point, model.project(point)), 2);
  }
  calibration_sigma_mm_ = std::sqrt(square / static_cast<double>(own.size()));
  check_.calibration_sigma_mm = calibration_sigma_mm_;
}

void CheckLimits::add(const std::string& name,
                      double deviation_mm,
                      double noise_mm,
                      double points,
                      std::string measured) {
  constexpr double kSigmas = 3.0;
  const double calibration_mm = std::sqrt(points) * calibration_sigma_mm_;
  const double sigma_mm = std::hypot(noise_mm, calibration_mm);
  const double floor_mm = options_.floor_share * distance_mm_;
  const double limit_mm = options_.tolerance_mm > 0.0 ? options_.tolerance_mm
                                                      : std::hypot(kSigmas * sigma_mm, floor_mm);
  check_.items.push_back({name + suffix_, deviation_mm, sigma_mm, limit_mm, std::move(measured)});
}

double spread_of(std::span<const double> heights) {
  std::vector<double> magnitudes;
  for (const double height : heights)
    magnitudes.push_back(std::abs(height));
  return 1.4826 * median(magnitudes);
}

namespace {

/// The spread by the median or the 80th percentile, whichever says more: a turntable whose axis
/// moved displaces only the faces that look along the motion.
double wide_spread_of(std::span<const double> heights) {
  constexpr double kShare = 0.8;
  constexpr double kQuantile = 1.2816;  // of the magnitude of a normal deviate
  if (heights.empty()) return 0.0;
  std::vector<double> magnitudes;
  for (const double height : heights)
    magnitudes.push_back(std::abs(height));
  const auto rank = magnitudes.begin() + static_cast<std::ptrdiff_t>(
                                             kShare * static_cast<double>(magnitudes.size() - 1));
  std::nth_element(magnitudes.begin(), rank, magnitudes.end());
  return std::max(spread_of(heights), *rank / kQuantile);
}

}  // namespace

void CheckLimits::add_spread(const std::string& name, const PatchDistances& patches) {
  // The spread of sound patches is their noise of one standard deviation. Of many patches half of
  // it more is not by chance: the share that three of are allowed.
  constexpr double kNoiseShare = 0.5;
  const double typical = wide_spread_of(patches.mean_mm);
  add(name,
      typical,
      kNoiseShare * median(patches.sigma_mm),
      2.0,
      fmt::format("{:.4f} mm, robust, over {} patches", typical, patches.mean_mm.size()));
}

}  // namespace frangia
