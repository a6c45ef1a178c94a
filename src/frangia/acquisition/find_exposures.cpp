#include "frangia/acquisition/find_exposures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/choose_exposures.h"
#include "frangia/core/error.h"

namespace frangia {

std::vector<double> find_exposures(RigDevices& devices,
                                   const Rig& rig,
                                   std::span<const Pattern> patterns,
                                   const CaptureOptions& options,
                                   std::optional<double> table_rad,
                                   const Run& run) {
  require(options.exposure != ExposureChoice::Given, "a given `exposure` is not searched for");
  const SafeStateGuard safe(devices);
  require(devices.reference() != nullptr,
          "the rig has no camera; add [devices.camera] to its rig.toml");
  require(devices.display != nullptr || devices.shifter != nullptr,
          "the rig shows no fringes; add [devices.fringes] to its rig.toml");
  CaptureDevices session(devices, rig, options, run);
  if (table_rad && devices.turntable && devices.turntable->info().can_home)
    session.turn_to(*table_rad);
  const ExposureRange range = exposure_range(devices, options);
  const ExposureProbe probe = [&](double exposure_ms) {
    run.check();
    run.note(fmt::format("trying {:.3g} ms", exposure_ms));
    return probe_exposure(patterns, rig, 0, session, exposure_ms);
  };
  std::vector<double> chosen;
  if (options.exposure == ExposureChoice::Bracketed) {
    ExposureBracket bracket(range);
    bracket.add_view(probe);
    chosen = bracket.selected();
  } else {
    chosen = {longest_exposure(probe, range)};
  }
  run.note(fmt::format("exposures chosen: {:.3g} ms", fmt::join(chosen, ", ")));
  return chosen;
}

}  // namespace frangia
