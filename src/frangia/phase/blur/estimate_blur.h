#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// The blur of an image, as the normal distribution over which the light of a point spreads.
struct ImageBlur {
  double variance_px2 = 0.0;  ///< along each axis, with 1/12 for the area of a pixel
  double u_px2 = 0.0;         ///< standard uncertainty of `variance_px2`

  /// Standard deviation of the distribution.
  [[nodiscard]] double sigma_px() const { return std::sqrt(variance_px2); }
};

/// Rows that lie together in the maps from which `estimate_blur` takes the slope of a phase.
inline constexpr int kBlurBandRows = 3;

/// The light of a pixel that a pattern modulates, where blur hardly weakens it.
struct WholeLight {
  /// The modulation of coarse fringes, or half the contrast of wide stripes.
  ///
  /// @units    counts
  /// @missing  NaN or 0 where it is not known
  Image<float> counts;
  double fringes = 0.0;  ///< in the field; 0 for stripes
};

/// The modulation of a map of coarse fringes.
[[nodiscard]] WholeLight whole_light(const WrappedPhase& coarse);

/// Half the difference between the brightest and the darkest frame of a Gray code at each pixel:
/// its wide stripes are blurred at their borders only, where others are not.
///
/// @shape    one exposure; a code with inverted frames, so that each pixel is bright in one frame
///           and dark in another
/// @missing  NaN where the brightest frame is saturated
[[nodiscard]] WholeLight whole_light(const FrameStack& gray);

/// Estimates the blur of a camera by how it weakens fringes. A blur of variance s^2 leaves
/// exp(-2 pi^2 s^2 f^2) of the modulation of fringes with f periods per pixel of the camera. f
/// differs with the slope of the surface. Light, albedo and the blur of the projector do not, so
/// that the logarithm of the ratio of both modulations lies on a line over f^2.
///
/// @shape    both hold bands of `kBlurBandRows` rows, as `sample_rows` takes them
/// @missing  none where slopes are too alike to tell, where the modulations lie on no line, and for
///           a blur that is hardly more than the area of a pixel
[[nodiscard]] std::optional<ImageBlur> estimate_blur(const WholeLight& whole,
                                                     const WrappedPhase& fine);

/// Variance of the area of a pixel along each axis, px^2.
inline constexpr double kPixelAreaVariance = 1.0 / 12.0;

/// The variance over which the pixels of a camera without a blur average the light: that of their
/// area, unless `fine` is clearly weakened less, as where a renderer casts a single ray for each
/// pixel. Then it is what the weakening shows.
///
/// @shape    as `estimate_blur`
/// @units    px^2
[[nodiscard]] double averaged_variance(const WholeLight& whole, const WrappedPhase& fine);

/// One clause about the blur for which a phase is corrected.
[[nodiscard]] std::string describe(const ImageBlur& blur);

}  // namespace frangia
