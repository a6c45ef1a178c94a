#pragma once

#include <array>
#include <span>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// Estimates the camera noise from the fringe frames of one or more views.
///
/// Four or more frames overdetermine the three unknowns of a pixel. The residual is noise, except
/// for step errors and motion, which are smooth across the image and cancel in a second difference
/// along the rows; harmonics of the fringes are fitted and subtracted. For three frames the second
/// difference is taken of the frames themselves, or of their mean where that varies less because
/// the fringes are fine, and a robust variance suppresses the texture of the object. A curve
/// fitted to the variance over the brightness gives the model.
///
/// Pixels that are cut off at 0 counts show less noise than they have; where they still show more
/// than the curve of the others, dark pixels get what they tell. Where all pixels are cut off in
/// some frame, the bright ones of them tell the noise: one frame of several has none.
///
/// @units    counts
/// @missing  saturated pixels are ignored; with too few pixels the model is quantization noise
/// @source   Immerkaer 1996 for the differences; EMVA 1288, photon transfer curve, for the line
class NoiseSamples {
 public:
  /// `distance_px`: between the pixels of a difference. White noise is the same at any distance;
  /// texture and what moved is more at a larger one.
  explicit NoiseSamples(int distance_px = 1) : distance_px_(distance_px) {}

  static constexpr int kBins = 24;  ///< bins of brightness
  /// Absolute differences and the brightness at which they were taken.
  struct Bin {
    std::vector<float> differences_counts;  ///< their expected square is the variance
    double sum_counts = 0.0;                ///< of the brightness
  };
  /// All of them.
  struct Bins {
    /// Of equal width in brightness, up to a white level or, where counts are far below it, a half
    /// or a quarter of it and so on: 12 bits are often stored in 16.
    std::array<Bin, kBins> lit;
    std::array<Bin, kBins> cut_off;  ///< pixels at 0 counts in some frame, likewise
  };
  /// Adds the samples of one stack. Stacks of other patterns than fringes are ignored.
  void add(const FrameStack& stack);
  void add(const NoiseSamples& other);     ///< of the same distance, of other frames
  [[nodiscard]] NoiseModel model() const;  ///< noise model fitted to all samples
  [[nodiscard]] bool empty() const;        ///< too few samples for a model
  [[nodiscard]] int white_level() const { return white_; }        ///< of the frames, counts
  [[nodiscard]] int distance_px() const { return distance_px_; }  ///< as it was constructed

 private:
  /// Makes the bins as wide as frames of this brightness need.
  void widen(double range_counts);

  Bins bins_;
  int white_ = 255;
  double range_counts_ = 0.0;  ///< of all bins together; 0 before the first frames
  int distance_px_;
};

/// Estimates one noise model from all stacks.
[[nodiscard]] NoiseModel estimate_noise(std::span<const FrameStack> stacks);

}  // namespace frangia
