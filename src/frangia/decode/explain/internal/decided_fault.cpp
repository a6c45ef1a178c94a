#include "frangia/decode/explain/internal/decided_fault.h"

#include <utility>

namespace frangia {

FrameExplanation decided_fault(const Pattern& pattern,
                               FrameCause cause,
                               std::vector<std::size_t> frames) {
  FrameExplanation found;
  found.pattern = pattern.name;
  found.decided = true;
  found.best = frame_hypotheses(pattern).front();
  found.best.cause = cause;
  found.best.faults = 1;
  if (cause == FrameCause::Lost) {
    for (const std::size_t frame : frames)
      found.best.free[frame] = true;
  }
  found.best.frames = std::move(frames);
  found.alike = {found.best};
  return found;
}

}  // namespace frangia
