#pragma once

#include <span>
#include <string>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// What was lost of frames before they were stored: by a compression in blocks, as of JPEG, MJPEG
/// and their kin, or by a format of few levels. A file without loss keeps the traces of both.
struct StorageLoss {
  double quality_scale = 0.0;     ///< steps of its quantization over those of quality 50; 0: none
  double level_counts = 0.0;      ///< from one level to the next; 0: that of the format
  double variance_counts2 = 0.0;  ///< that it adds to each pixel beyond the noise of the frames
};

/// Looks for traces of a loss in the frames of one view.
///
/// A compression cuts an image into blocks of 8 x 8 pixels and stores the cosine transform of each,
/// every coefficient as a multiple of a quantization step; most of those of high frequency become
/// zero. Windows of the same size that lie across the borders of the blocks show neither. Frames of
/// few levels hold some counts often, and none of the counts between them.
///
/// @shape    all stacks of one view
/// @source   ITU-T T.81 for the steps; `jpeg_noise_counts2` for what they cost
[[nodiscard]] StorageLoss find_storage_loss(std::span<const FrameStack> stacks);

/// One sentence about the loss, with what to do; empty without one.
[[nodiscard]] std::string describe(const StorageLoss& loss);

}  // namespace frangia
