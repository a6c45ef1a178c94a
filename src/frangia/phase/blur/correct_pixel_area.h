#pragma once

#include "frangia/core/image.h"
#include "frangia/phase/blur/estimate_blur.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Corrects a phase for the area of the pixels, over which a camera without any blur averages the
/// light: as in `correct_blur`, by s^2 (grad(ln B) . k + tr H / 2) with s^2 = 1/12 px^2 or
/// `variance_px2`, B the modulation, k the gradient of the phase and H its Hessian. Left as it is,
/// it makes the radius R of a ball smaller by about w^2 / 8 R, w the width of a pixel on it.
///
/// The derivatives are those of the 5 x 5 pixels around one, and add half a percent to the noise of
/// the phase. Next to a border of brightness or a crease, which only pixels on it mix, the smallest
/// ones count. What the correction may be off, some micrometres where a
/// pixel is half a millimetre wide, enters `systematic_rad` unless that is empty.
/// @shape    `modulation_counts` covers `box` alone
/// @units    rad, counts
/// @missing  a pixel without 24 neighbours on the same surface keeps its phase
void correct_pixel_area(AbsolutePhase& phase,
                        const Image<float>& modulation_counts,
                        const PixelBox& box,
                        double variance_px2 = kPixelAreaVariance);

}  // namespace frangia
