#pragma once

#include <vector>

#include "frangia/frames/frame.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// What the camera saw of one pattern, in the order of its shifts. A pattern taken at several
/// exposures has a stack for each, one after the other.
struct FrameStack {
  Pattern pattern;
  std::vector<Frame> frames;  ///< pattern.frame_count() images of one size and depth
  int white_level = 255;      ///< a pixel at or above this holds no measurement
  int exposure = 0;           ///< index into pattern.exposures_ms

  /// How much more light this stack took than the pattern's first one.
  [[nodiscard]] double gain() const {
    if (pattern.exposures_ms.empty()) return 1.0;
    return pattern.exposures_ms[static_cast<std::size_t>(exposure)] / pattern.exposures_ms.front();
  }
};

}  // namespace frangia
