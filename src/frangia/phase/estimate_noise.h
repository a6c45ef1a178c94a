#pragma once

#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// The camera's noise, measured from the fringe frames of a view.
///
/// Four or more frames overdetermine the three unknowns of a pixel: what is left over is noise, but
/// for step errors and motion, which are smooth across the image and go with a second difference
/// along the rows. Of three frames that difference is taken of the frames themselves, and the
/// object's texture is kept out by medians. A line through the variance against the brightness
/// gives floor and slope.
///
/// missing  saturated pixels are left out; with too few pixels the floor of quantisation remains
/// source   Immerkaer 1996 for the differences; the photon transfer curve, EMVA 1288, for the line
[[nodiscard]] NoiseModel estimate_noise(std::span<const FrameStack> stacks);

}  // namespace frangia
