#pragma once

#include <algorithm>

namespace frangia {

/// Camera noise: the variance of a pixel as a linear function of its counts.
///
/// var = floor + slope * counts, where floor = (read noise / gain)^2 + 1/12 (quantization) and
/// slope = 1 / gain (shot noise). The gain is in electrons per count.
///
/// @units    counts squared
/// @source   EMVA 1288, photon transfer
struct NoiseModel {
  double floor_counts2 = 1.0 / 12.0;  ///< variance of a dark pixel
  double slope_counts = 0.0;          ///< increase of the variance per count of brightness

  /// Returns the model of a camera whose gain and read noise (electrons, rms) are known.
  [[nodiscard]] static NoiseModel from_camera(double gain_e_per_count, double read_e) {
    const double read_counts = read_e / gain_e_per_count;
    return {read_counts * read_counts + 1.0 / 12.0, 1.0 / gain_e_per_count};
  }
  /// Returns the variance of a pixel in counts squared. Negative `counts` are treated as 0.
  [[nodiscard]] double variance(double counts) const {
    return floor_counts2 + slope_counts * std::max(counts, 0.0);
  }
};

}  // namespace frangia
