#include "frangia/pipeline/internal/calibrate_check_limits.h"

#include <cmath>
#include <utility>

#include "frangia/core/median.h"
#include "frangia/range/calibration_uncertainty.h"

namespace frangia {

CheckLimits::CheckLimits(const Rig& rig,
                         const std::vector<Eigen::Vector3d>& points,
                         const CheckRigOptions& options,
                         RigCheck& check)
    : options_(options), check_(check) {
  for (const Eigen::Vector3d& point : points)
    check.distance_mm += point.norm() / static_cast<double>(points.size());
  if (!rig.calibration || rig.calibration->covariance.empty()) return;
  Pattern pattern;
  (rig.projector.is_angular() ? pattern.fringes_per_degree : pattern.period_px) = 1.0;
  std::vector<Eigen::Vector3d> some;
  constexpr std::size_t kMost = 500;
  for (std::size_t i = 0; i < points.size(); i += points.size() / kMost + 1)
    some.push_back(points[i]);
  const CalibrationUncertainty uncertainty(rig, pattern, some);
  double square = 0.0;
  for (const Eigen::Vector3d& point : some) {
    const Eigen::Vector2d pixel = rig.camera.model.project(point);
    square += std::pow(uncertainty.along_ray_mm(pixel.x(), pixel.y(), point.z()), 2);
  }
  check.calibration_sigma_mm = std::sqrt(square / static_cast<double>(some.size()));
}

void CheckLimits::add(
    std::string name, double deviation_mm, double noise_mm, double points, std::string measured) {
  constexpr double kSigmas = 3.0;
  const double calibration_mm = std::sqrt(points) * check_.calibration_sigma_mm;
  const double sigma_mm = std::hypot(noise_mm, calibration_mm);
  const double floor_mm = options_.floor_share * check_.distance_mm;
  const double limit_mm = options_.tolerance_mm > 0.0 ? options_.tolerance_mm
                                                      : std::hypot(kSigmas * sigma_mm, floor_mm);
  check_.items.push_back({std::move(name), deviation_mm, sigma_mm, limit_mm, std::move(measured)});
}

double spread_of(std::span<const double> heights) {
  std::vector<double> magnitudes;
  for (const double height : heights)
    magnitudes.push_back(std::abs(height));
  return 1.4826 * median(magnitudes);
}

}  // namespace frangia
