#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/targets/measure_scale.h"

namespace frangia {

/// A target after all views were registered.
struct MeasuredTarget {
  int code = -1;                                        ///< -1: it has none
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< object frame
  double sigma_mm = 0.0;    ///< root mean square of the standard uncertainties of its coordinates
  std::size_t views = 0;    ///< that saw it
  std::vector<int> setups;  ///< that saw it, as scan.toml numbers them
};

/// What the targets of a scan say.
struct TargetsReport {
  std::vector<MeasuredTarget> targets;  ///< that any view saw
  std::size_t tying = 0;                ///< targets that several views saw
  std::size_t tying_setups = 0;         ///< targets that several setups saw
  double rms_mm = 0.0;                  ///< of the views' centres from those of the targets
  double over_sigma = 0.0;  ///< root mean square of the same over their standard deviations
  std::optional<TargetScale> scale;  ///< none without known distances
  std::size_t masked = 0;            ///< points of stickers, which are not part of the surface
  std::size_t filled = 0;            ///< holes under targets

  [[nodiscard]] std::string text() const;  ///< the result as a sentence
};

}  // namespace frangia
