#include "frangia/acquisition/preview.h"

#include <utility>

#include "frangia/acquisition/capture_options.h"
#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/core/error.h"

namespace frangia {

void preview(RigDevices& devices, const Rig& rig, const PreviewEvents& events, const Run& run) {
  const SafeStateGuard safe(devices);
  require(devices.reference() != nullptr,
          "the rig has no camera; add [devices.camera] to its rig.toml");
  require(devices.display != nullptr || devices.shifter != nullptr,
          "the rig shows no fringes; add [devices.fringes] to its rig.toml");
  const CaptureOptions options;
  CaptureDevices session(devices, rig, options, run);
  PreviewSettings settings;
  CameraSettings effective;
  std::size_t pattern = 0;
  int frame = 0;
  int attempt = 0;
  int generation = 0;
  for (;;) {
    run.check();
    if (auto fresh = events.next_settings()) {
      require(!fresh->patterns.empty(), "a preview needs at least one pattern");
      const bool turns = fresh->table_rad != settings.table_rad;
      settings = std::move(*fresh);
      const double exposure_s = 1e-3 * settings.camera.exposure_ms;
      effective = devices.reference()->configure(
          settings.camera, Deadline::in(options.timeout_s + exposure_s, run.stop));
      if (turns) session.turn_to(settings.table_rad);
      pattern = 0;
      frame = 0;
      ++generation;
    }
    require(!settings.patterns.empty(), "a preview begins with settings");
    const Pattern& shown = settings.patterns[pattern];
    if (frame == 0) session.begin_set(shown, 1.0);
    session.show(shown, frame);
    // Another attempt each time: a simulated camera then draws other noise.
    CompleteFrame captured =
        session.capture({.pattern = shown.name, .frame = frame, .attempt = attempt});
    events.on_frame({std::move(captured.frame), pattern, frame, effective, generation});
    if (++frame < shown.frame_count()) continue;
    session.end_set();
    frame = 0;
    if (++pattern == settings.patterns.size()) {
      pattern = 0;
      ++attempt;
    }
  }
}

}  // namespace frangia
