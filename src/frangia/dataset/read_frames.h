#pragma once

#include <cstddef>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Reads the frames of one view, several files at a time.
///
/// @shape    one stack per pattern and exposure, in the order of `scan.patterns`
/// @units    counts
/// @errors   Error(Input) that names the first file that is missing, surplus, of another size than
///          the rig's camera, of another bit depth than the view's first frame, or brighter than
///          the rig's white level
[[nodiscard]] std::vector<FrameStack> read_frames(const Scan& scan,
                                                  std::size_t view,
                                                  const Run& run = {});

}  // namespace frangia
