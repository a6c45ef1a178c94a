#include "frangia/service/check_scan.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stop_token>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/internal/opened_devices.h"
#include "frangia/service/internal/project_names.h"
#include "frangia/service/live_preview.h"

namespace frangia {

ScanCheck check_scan(const ProjectFolder& project,
                     const CaptureSettings& settings,
                     const CaptureSetup& setup,
                     const Run& run) {
  const Rig rig = read_rig(project.rig(), run);
  OpenedDevices devices(project.rig(), rig, setup.drivers(), setup, run);
  run.stage("preview");
  std::stop_source enough;
  const std::stop_callback by_user(run.stop, [&] { enough.request_stop(); });
  std::shared_ptr<const LiveDecode> seen;
  std::optional<LivePreview> live;
  live.emplace(rig, LiveSettings{.capture = settings}, [&] {
    const auto newest = live->snapshot();
    if (newest == nullptr || newest->decode == nullptr) return;
    seen = newest->decode;
    enough.request_stop();
  });
  Run looking = run;
  looking.stop = enough.get_token();
  try {
    live->run(devices.devices(), looking);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Cancelled || seen == nullptr) throw;
  }
  run.check();
  ScanCheck check;
  check.at_s = seconds_since_1970();
  if (!seen) return check;
  double contrast = kMissing;
  for (const auto& direction : seen->view.directions) {
    if (direction.assessments.empty()) continue;
    const auto& finest = direction.assessments.back();
    contrast = std::fmin(contrast, finest.contrast);
    check.saturated = std::max(check.saturated, finest.saturated_fraction);
  }
  if (!std::isnan(contrast)) check.contrast = contrast;
  check.points = seen->points;
  check.finding = seen->finding;
  return check;
}

}  // namespace frangia
