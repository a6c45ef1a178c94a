#pragma once

#include <vector>

#include "frangia/frames/frame.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// What the camera saw of one pattern, in the order of its shifts.
struct FrameStack {
  Pattern pattern;
  std::vector<Frame> frames;  ///< pattern.frame_count() images of one size and depth
  int white_level = 255;      ///< a pixel at or above this holds no measurement
};

}  // namespace frangia
