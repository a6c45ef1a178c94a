#include "frangia/acquisition/internal/probe_exposure.h"

#include "frangia/acquisition/internal/assess_set.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

const Pattern& finest_fringes(std::span<const Pattern> patterns) {
  const Pattern* finest = nullptr;
  for (const Pattern& pattern : patterns) {
    if (pattern.kind != PatternKind::Fringe) continue;
    if (finest == nullptr || pattern.fringes_per_unit() > finest->fringes_per_unit())
      finest = &pattern;
  }
  require(
      finest != nullptr,
      "an automatic exposure, or a wait for drift, needs a fringe pattern; add one to the plan");
  return *finest;
}

}  // namespace

FrameStack capture_finest(std::span<const Pattern> patterns,
                          const Rig& rig,
                          int view,
                          CaptureDevices& devices,
                          double exposure_ms) {
  FrameStack stack{finest_fringes(patterns), {}, rig.reference().white_level};
  stack.pattern.exposures_ms.clear();
  devices.begin_set(stack.pattern, 1.0);
  devices.expose_for(exposure_ms);
  for (int frame = 0; frame < stack.pattern.frame_count(); ++frame) {
    devices.show(stack.pattern, frame);
    stack.frames.push_back(devices.capture({view, stack.pattern.name, frame, 0, 0}).frame);
  }
  return stack;
}

Image<PixelStatus> probe_exposure(std::span<const Pattern> patterns,
                                  const Rig& rig,
                                  int view,
                                  CaptureDevices& devices,
                                  double exposure_ms) {
  return pixel_status_of(capture_finest(patterns, rig, view, devices, exposure_ms),
                         rig.reference().noise);
}

}  // namespace frangia
