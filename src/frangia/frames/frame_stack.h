#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// A grey image as recorded by the camera. Eight-bit frames stay eight-bit, because memory traffic
/// limits the speed of decoding.
using Frame = std::variant<Image<std::uint8_t>, Image<std::uint16_t>>;

/// Returns the number of columns.
[[nodiscard]] inline int width_of(const Frame& frame) {
  return std::visit([](const auto& image) { return image.width(); }, frame);
}
/// Returns the number of rows.
[[nodiscard]] inline int height_of(const Frame& frame) {
  return std::visit([](const auto& image) { return image.height(); }, frame);
}
/// Returns the value of one pixel in counts. In loops over pixels, visit the variant once instead.
[[nodiscard]] inline int counts_at(const Frame& frame, int x, int y) {
  return std::visit([&](const auto& image) { return static_cast<int>(image(x, y)); }, frame);
}

/// The frames of one pattern, in the order of its shifts. A pattern taken at several exposures has
/// one stack per exposure.
struct FrameStack {
  Pattern pattern;            ///< pattern that the frames show
  std::vector<Frame> frames;  ///< pattern.frame_count() images of one size and depth
  int white_level = 255;      ///< a pixel at or above this level is saturated
  int exposure = 0;           ///< index into pattern.exposures_ms
  /// Variance that a lossy compression added to each pixel, counts squared.
  double compression_counts2 = 0.0;
  /// Of a white or ambient frame in colour: linear red, green and blue as shares of full scale.
  /// `frames` then holds its luminance.
  Image<Eigen::Vector3f> color{};
  /// Noise of the phase of each pixel over that of frames all of which are measured; empty: 1
  /// everywhere.
  Image<float> noise_gain{};

  /// Exposure time relative to the first exposure of the pattern.
  [[nodiscard]] double gain() const {
    if (pattern.exposures_ms.empty()) return 1.0;
    return pattern.exposures_ms[static_cast<std::size_t>(exposure)] / pattern.exposures_ms.front();
  }
};

}  // namespace frangia
