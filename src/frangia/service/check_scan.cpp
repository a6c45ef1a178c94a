#include "frangia/service/check_scan.h"

#include <chrono>
#include <memory>
#include <optional>
#include <stop_token>

#include "frangia/core/error.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/internal/opened_devices.h"
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
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  check.at_s = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  if (!seen) return check;
  const auto& assessments = seen->view.directions.front().assessments;
  if (!assessments.empty()) {
    check.contrast = assessments.back().contrast;
    check.saturated = assessments.back().saturated_fraction;
  }
  check.points = seen->points;
  check.finding = seen->finding;
  return check;
}

}  // namespace frangia
