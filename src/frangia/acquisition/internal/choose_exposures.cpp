#include "frangia/acquisition/internal/choose_exposures.h"

#include <fmt/format.h>

#include "frangia/acquisition/internal/survey_exposures.h"

namespace frangia {

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
  return chosen;
}

}  // namespace frangia
