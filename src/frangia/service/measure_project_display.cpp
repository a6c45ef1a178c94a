#include "frangia/service/measure_project_display.h"

#include <string>

#include "frangia/acquisition/with_display.h"
#include "frangia/core/read_text_file.h"
#include "frangia/core/write_text_file.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/internal/opened_devices.h"
#include "frangia/service/rig_history.h"

namespace frangia {

DisplayMeasurement measure_project_display(const ProjectFolder& project,
                                           const CaptureSettings& settings,
                                           const CaptureSetup& setup,
                                           const Run& run) {
  const Rig rig = read_rig(project.rig(), run, RigContent::StartValues);
  CaptureOptions options;
  options.camera = settings.camera;
  DisplayMeasurement found;
  {
    OpenedDevices opened(project.rig(), rig, setup.drivers(), setup, run);
    found = measure_display(opened.devices(), rig, options, run);
  }
  const std::string text = with_display(read_text_file(project.rig()), rig, found);
  keep_rig(project, RigChange::Display);
  write_text_file(project.rig(), text, Durability::Synced);
  return found;
}

}  // namespace frangia
