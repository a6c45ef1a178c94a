#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/pipeline/calibrate_check.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Limits of the deviations of one check.
class CheckLimits {
 public:
  CheckLimits(const Rig& rig,
              const std::vector<Eigen::Vector3d>& points,
              const CheckRigOptions& options,
              RigCheck& check);

  /// Adds a figure. `points`: how many independent points of the calibration's uncertainty it has.
  void add(
      std::string name, double deviation_mm, double noise_mm, double points, std::string measured);

 private:
  const CheckRigOptions& options_;
  RigCheck& check_;
};

/// Standard deviation of heights by the median of their magnitudes, which the edges of a plate do
/// not change.
[[nodiscard]] double spread_of(std::span<const double> heights);

}  // namespace frangia
