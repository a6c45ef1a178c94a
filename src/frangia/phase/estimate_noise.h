#pragma once

#include <array>
#include <span>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// The camera's noise, measured from fringe frames; of one view, or pooled over several.
///
/// Four or more frames overdetermine the three unknowns of a pixel: what is left over is noise, but
/// for step errors and motion, which are smooth across the image and go with a second difference
/// along the rows. Of three frames that difference is taken of the frames themselves, and the
/// object's texture is kept out by medians. A line through the variance against the brightness
/// gives floor and slope.
///
/// missing  saturated pixels are left out; with too few pixels the floor of quantisation remains
/// source   Immerkaer 1996 for the differences; the photon transfer curve, EMVA 1288, for the line
class NoiseSamples {
 public:
  static constexpr int kBins = 24;  ///< of brightness
  /// Takes the samples of one stack; other than fringes are passed over.
  void add(const FrameStack& stack);
  [[nodiscard]] NoiseModel model() const;

 private:
  std::array<std::vector<float>, kBins> bins_;
  int white_ = 255;
};

/// The noise of all stacks together.
[[nodiscard]] NoiseModel estimate_noise(std::span<const FrameStack> stacks);

}  // namespace frangia
