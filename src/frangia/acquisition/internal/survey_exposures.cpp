#include "frangia/acquisition/internal/survey_exposures.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/acquisition/internal/assess_set.h"

namespace frangia {
namespace {

const Pattern& finest_fringes(const Scan& plan) {
  const Pattern* finest = nullptr;
  for (const Pattern& pattern : plan.patterns) {
    if (pattern.kind != PatternKind::Fringe) continue;
    if (finest == nullptr || pattern.fringes_per_unit() > finest->fringes_per_unit())
      finest = &pattern;
  }
  require(finest != nullptr, "an automatic exposure needs a fringe pattern; add one to the plan");
  return *finest;
}

/// Pixel states of the current view for the finest fringes at an exposure.
Image<PixelStatus> probe(const Scan& plan,
                         std::size_t view,
                         CaptureDevices& devices,
                         double exposure_ms) {
  FrameStack stack{finest_fringes(plan), {}, plan.rig.camera.white_level};
  stack.pattern.exposures_ms.clear();
  devices.begin_set(stack.pattern, 1.0);
  devices.expose_for(exposure_ms);
  for (int frame = 0; frame < stack.pattern.frame_count(); ++frame) {
    devices.show(stack.pattern, frame);
    stack.frames.push_back(
        devices.capture({static_cast<int>(view), stack.pattern.name, frame, 0, 0}).frame);
  }
  return pixel_status_of(stack, plan.rig.camera.noise);
}

}  // namespace

std::vector<double> survey_exposures(const Scan& plan,
                                     CaptureDevices& devices,
                                     TableMover& table,
                                     const CaptureOptions& options,
                                     ExposureRange range,
                                     const Run& run) {
  constexpr std::size_t kViews = 4;
  const bool bracketed = options.exposure == ExposureChoice::Bracketed;
  ExposureBracket bracket(range);
  const std::size_t views = std::min(kViews, plan.views.size());
  for (std::size_t i = 0; i < views; ++i) {
    run.check();
    const std::size_t view = i * plan.views.size() / views;
    table.turn_to(plan.views[view].angle_rad);
    const ExposureProbe probe_here = [&](double exposure_ms) {
      run.check();
      return probe(plan, view, devices, exposure_ms);
    };
    if (bracketed) {
      bracket.add_view(probe_here);
    } else {
      range.initial_ms = longest_exposure(probe_here, range);
      range.max_ms = range.initial_ms;  // the other views can only shorten it
    }
  }
  std::vector<double> chosen =
      bracketed ? bracket.selected() : std::vector<double>{range.initial_ms};
  run.note(fmt::format("exposures chosen: {:.3g} ms", fmt::join(chosen, ", ")));
  return chosen;
}

}  // namespace frangia
