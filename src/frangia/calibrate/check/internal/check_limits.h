#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/check/calibrate_check.h"
#include "frangia/calibrate/check/check_kinds.h"
#include "frangia/calibrate/check/internal/compare_views.h"

namespace frangia {

/// Limits of the deviations of one check.
class CheckLimits {
 public:
  /// `points` are in the frame of the camera.
  CheckLimits(const CheckedCamera& camera,
              const std::vector<Eigen::Vector3d>& points,
              const CheckRigOptions& options,
              RigCheck check = {});

  /// Adds a figure. `points`: how many independent points of the calibration's uncertainty it has.
  void add(const std::string& name,
           double deviation_mm,
           double noise_mm,
           double points,
           std::string measured);
  /// Adds the robust spread of patches that were measured twice.
  void add_spread(const std::string& name, const PatchDistances& patches);
  /// The check with all figures.
  [[nodiscard]] const RigCheck& result() const { return check_; }

 private:
  const CheckRigOptions& options_;
  RigCheck check_;
  std::string suffix_;  ///< names a further camera
  double distance_mm_ = 0.0;
  double calibration_sigma_mm_ = 0.0;
};

/// Standard deviation of heights by the median of their magnitudes, which the edges of a plate do
/// not change.
[[nodiscard]] double spread_of(std::span<const double> heights);

}  // namespace frangia
