#pragma once

#include <vector>

#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Smooths rows of a phase by a mean filter over a square window.
///
/// @units    rad
/// @missing  a missing pixel stays missing and does not contribute
class RowSmoother {
 public:
  /// The phase must outlive the smoother.
  RowSmoother(const AbsolutePhase& in, int radius_px);

  /// Computes row `y`: the mean over the neighbours that agree within three sigmas of their
  /// difference. Opposite neighbours count in pairs, because an asymmetric window would be biased
  /// by the slope of the phase.
  void smooth(int y);

  /// The phase of the last smoothed row.
  [[nodiscard]] const float* phase_rad() const { return phase_.data(); }
  /// The standard deviations of the last smoothed row.
  [[nodiscard]] const float* sigma_rad() const { return sigma_.data(); }

 private:
  /// Smooths the pixels [begin, end) of a row, none of which is missing.
  void smooth_run(int y, int begin, int end);

  const AbsolutePhase& in_;
  int radius_;
  std::vector<float> phase_, sigma_;
  std::vector<float> limit_;  ///< largest difference of a neighbour that agrees
  std::vector<float> added_;  ///< number of pixels in `sum_`
  std::vector<double> sum_;
};

}  // namespace frangia
