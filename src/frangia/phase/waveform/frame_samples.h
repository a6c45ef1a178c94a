#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Samples about `wanted` pixels of a stack on a regular grid, for fits over the whole image.
/// Pixels that are saturated in any frame are omitted.
///
/// @shape    one row per pixel, one column per frame
/// @units    counts
[[nodiscard]] Eigen::ArrayXXf sample_frames(const FrameStack& stack, std::size_t wanted);

/// Samples evenly spaced bands of `together` rows that hold about `wanted` pixels, for estimates
/// that do not need all rows.
[[nodiscard]] FrameStack sample_rows(const FrameStack& stack, std::size_t wanted, int together = 1);

/// Samples single pixels, for the phase at a few of them.
///
/// @shape    one index y * width + x for each pixel in, one row of these pixels out
[[nodiscard]] FrameStack sample_pixels(const FrameStack& stack,
                                       std::span<const std::uint32_t> pixels);

/// Cuts the pixels of a box out of all frames.
///
/// @errors   Error(Input) when the box leaves the frames
[[nodiscard]] FrameStack sample_box(const FrameStack& stack, const PixelBox& box);

/// Samples every `step`-th pixel along both axes, beginning with pixel (0, 0).
///
/// @errors   Error(Input) when the step is less than one pixel
[[nodiscard]] FrameStack sample_grid(const FrameStack& stack, int step);

}  // namespace frangia
