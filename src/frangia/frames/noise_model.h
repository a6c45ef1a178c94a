#pragma once

#include <algorithm>

namespace frangia {

/// Camera noise: the variance of a pixel as a function of its counts.
///
/// var = floor + slope * counts, where floor = (read noise / gain)^2 + 1/12 (quantization) and
/// slope = 1 / gain (shot noise). The gain is in electrons per count. A camera that encodes its
/// light, as webcams do, brightens what is dark, and its noise with it: then the slope is 0, and
/// dark * (range / (counts + range))^2 comes to the floor.
///
/// @units    counts squared
/// @source   EMVA 1288, photon transfer
struct NoiseModel {
  double floor_counts2 = 1.0 / 12.0;  ///< variance of a dark pixel
  double slope_counts = 0.0;          ///< increase of the variance per count of brightness
  double dark_counts2 = 0.0;          ///< what a dark pixel has beyond the floor
  double dark_range_counts = 1.0;     ///< brightness at which a quarter of that is left, above 0

  /// Returns the model of a camera whose gain and read noise (electrons, rms) are known.
  [[nodiscard]] static NoiseModel from_camera(double gain_e_per_count, double read_e) {
    const double read_counts = read_e / gain_e_per_count;
    return {.floor_counts2 = read_counts * read_counts + 1.0 / 12.0,
            .slope_counts = 1.0 / gain_e_per_count};
  }
  /// Returns the variance of a pixel in counts squared. Negative `counts` are treated as 0.
  [[nodiscard]] double variance(double counts) const {
    const double bright = std::max(counts, 0.0);
    const double left = dark_range_counts / (bright + dark_range_counts);
    return floor_counts2 + slope_counts * bright + dark_counts2 * left * left;
  }
};

}  // namespace frangia
