#include "frangia/acquisition/internal/choose_exposures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/acquisition/internal/probe_exposure.h"

namespace frangia {
namespace {

/// Chooses exposures from up to four views, evenly over the plan: one exposure, or a bracket in the
/// order of the pixels that each adds.
///
/// @units    ms
/// @errors   Error(Input) without a pattern of fringes, and those of the devices
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

void warn_of_uneven_light(const std::vector<double>& exposures_ms, double step_ms, const Run& run) {
  constexpr double kSame = 0.01;  // of a step
  if (step_ms <= 0.0) return;
  for (const double exposure_ms : exposures_ms) {
    const double steps = std::max(1.0, std::round(exposure_ms / step_ms));
    if (std::abs(exposure_ms / step_ms - steps) < kSame) continue;
    run.warn(
        fmt::format("exposures of {:.4g} ms see the light of room and display uneven; expose for "
                    "{:.4g} ms, a whole multiple of the exposure_step_ms of [devices.camera]",
                    exposure_ms,
                    steps * step_ms));
    return;
  }
}

}  // namespace

ChosenExposures choose_exposures(Scan& plan,
                                 CaptureDevices& devices,
                                 const ExposureRange& range,
                                 TableMover& table,
                                 CaptureManifest& manifest,
                                 const CaptureOptions& options,
                                 const Run& run) {
  ChosenExposures chosen;
  chosen.single_ms = options.camera.exposure_ms;
  if (options.exposure != ExposureChoice::Given) {
    if (manifest.exposures_ms().empty()) {
      if (manifest.damaged_lines() > 0) {
        throw Error(ErrorKind::Input,
                    fmt::format("{}: {} is damaged and lacks the exposures that were chosen; start "
                                "the scan in a new folder",
                                plan.folder.string(),
                                CaptureManifest::kFileName));
      }
      manifest.add_exposures(survey_exposures(plan, devices, table, options, range, run));
    }
    chosen.fringes_ms = manifest.exposures_ms();
    chosen.single_ms = chosen.fringes_ms.front();
  }
  for (Pattern& pattern : plan.patterns) {
    const bool fringes = pattern.kind == PatternKind::Fringe || pattern.kind == PatternKind::Gray;
    if (options.exposure == ExposureChoice::Bracketed && fringes)
      pattern.exposures_ms = chosen.fringes_ms;
    if (fringes && !pattern.exposures_ms.empty()) {
      chosen.single_ms = pattern.exposures_ms.front();  // also for the laser sheet
      chosen.fringes_ms = pattern.exposures_ms;
    }
  }
  if (chosen.fringes_ms.empty()) chosen.fringes_ms = {chosen.single_ms};
  warn_of_uneven_light(chosen.fringes_ms, range.step_ms, run);
  return chosen;
}

}  // namespace frangia
