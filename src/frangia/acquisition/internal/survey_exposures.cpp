#include "frangia/acquisition/internal/survey_exposures.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/acquisition/internal/probe_exposure.h"

namespace frangia {

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
      return probe_exposure(plan.patterns, plan.rig, static_cast<int>(view), devices, exposure_ms);
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
