#include "frangia/acquisition/internal/choose_exposures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/acquisition/internal/survey_exposures.h"

namespace frangia {
namespace {

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
