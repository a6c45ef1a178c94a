#pragma once

#include <string>

#include "frangia/core/run.h"

namespace frangia {

/// What indirect light does to a scan.
struct IndirectLightReport {
  double albedo = 0.0;      ///< reflectance of the surface that explains the frames, 0 to 1
  double affected = 0.0;    ///< share of the points to which it adds more than half of their noise
  double largest_mm = 0.0;  ///< standard uncertainty that it adds, 95th percentile, along the ray
  double noise_mm = 0.0;    ///< median noise of the points
  bool corrected = true;    ///< the points; otherwise sigma counts the whole error

  /// Whether it matters for more than a few points.
  [[nodiscard]] bool is_large() const { return affected > 0.02; }
  /// One sentence without a full stop.
  [[nodiscard]] std::string text() const;
};

/// Warns of indirect light that matters, or notes it.
void announce(const IndirectLightReport& report, const Run& run);

}  // namespace frangia
