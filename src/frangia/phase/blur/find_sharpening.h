#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// A camera that sharpens its images by an unsharp mask: it adds `amount` times the difference
/// between an image and that image blurred by `radius_px`.
struct CameraSharpening {
  double amount = 0.0;     ///< times the difference between the image and the blurred one
  double radius_px = 0.0;  ///< sigma of the mask's normal blur
};

/// Weights of the pixels 0, 1, ... beside one in a normal blur, which it has on both sides.
[[nodiscard]] std::vector<double> blur_weights(double radius_px);

/// Finds the sharpening of a camera by what it does to noise. The noise of a sensor is white; that
/// of a sharpened image has the square of the mask as its spectrum, so that neighbouring pixels
/// differ from each other more than from those farther away.
///
/// Noise is what no fringe explains: the residuals of four frames or more, or the differences
/// between the means of patterns of three, without what repeats with the phase and with the light.
/// The products of neighbouring pixels are compared with those that each amount and radius
/// predict. Noise that a colour filter or a compression blurred tells nothing.
///
/// @shape    all stacks of one view
/// @units    `storage_counts2`: variance of a pixel by a loss before storage, counts squared
/// @missing  nothing unless the pixels beside and below one both contradict it, and a mask explains
///           nearly all that white noise leaves; nothing where the noise is below that of the
///           rounding to counts or of the storage, and for a single pattern of three frames
[[nodiscard]] std::optional<CameraSharpening> find_sharpening(std::span<const FrameStack> stacks,
                                                              double storage_counts2 = 0.0);

/// A sentence: "the camera sharpens its frames ...".
[[nodiscard]] std::string describe(const CameraSharpening& sharpening);

}  // namespace frangia
