#include <filesystem>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/core/make_folder.h"
#include "frangia/files/write_mesh.h"
#include "frangia/pipeline/reconstruct.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {
namespace {

/// Figures of a reconstruction, as surface.json keeps them.
std::string summary_of(const Reconstruction& result) {
  nlohmann::ordered_json json{{"points", result.points}, {"views", result.views}};
  if (result.registration) {
    json["registration"] = result.registration->text();
    json["rms_before_mm"] = result.registration->rms_before_mm;
    json["rms_after_mm"] = result.registration->rms_after_mm;
  }
  json["untrusted_reason"] = result.untrusted_reason;
  return json.dump();
}

}  // namespace

nlohmann::ordered_json Service::Implementation::start_scan(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  std::vector<ProjectStation> stations;
  bool can_scan = false;
  CaptureSettings settings;
  {
    const std::lock_guard lock(mutex_);
    stations = project_->stations;
    can_scan = project_->can_scan;
    settings = project_->capture;
  }
  const std::size_t asked =
      arguments.whole_or("stations", stations.empty() ? 8 : stations.size(), 1, kMostStations);
  CaptureSetup setup = options_.capture;
  if (const auto angle = arguments.number("table_deg")) setup.table_at_rad = rad_from_deg(*angle);
  arguments.check_all_read();
  require(can_scan, "this project has no rig with devices; create one to scan");
  std::error_code ignored;
  const bool begun = std::filesystem::exists(project.scan / "capture", ignored);
  require(!begun || asked == stations.size(),
          "the scan has begun; its number of stations cannot change");
  if (asked != stations.size()) stations = planned_stations(asked);
  change([&](OpenProject& opened) {
    opened.scan_begun = true;
    opened.unknown_angle.reset();
  });
  return started("scan", [this, project, stations, settings, setup](const Run& run) {
    CaptureReport report;
    try {
      report = capture_project(
          project,
          stations,
          settings,
          setup,
          [this](const std::vector<ProjectStation>& all) {
            change([&](OpenProject& opened) { opened.stations = all; });
          },
          run);
    } catch (const UnknownTableAngle& error) {
      change([&](OpenProject& opened) { opened.unknown_angle = error; });
      throw;
    }
    change([&](OpenProject& opened) { opened.scan_complete = true; });
    refresh_projects();
    run.note(fmt::format("{} frames captured, {} already there", report.captured, report.resumed));
  });
}
/// The station's frames are deleted, so that the scan is incomplete until they are captured again.
nlohmann::ordered_json Service::Implementation::rescan_station(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  const OpenProject before = opened();
  require(!before.stations.empty(), "this project has no stations; scan it first");
  const std::size_t station = arguments.whole("station", 0, before.stations.size() - 1);
  arguments.check_all_read();
  require(before.can_scan, "this project has no rig with devices; create one to scan");
  require_idle();
  std::vector<ProjectStation> stations = before.stations;
  stations[station] = {.angle_deg = stations[station].angle_deg};
  std::filesystem::remove(project.scan / "scan.toml");
  std::filesystem::remove_all(project.scan / "views" / fmt::format("{:03}", station));
  write_stations(project, stations);
  change([&](OpenProject& now) {
    now.stations = stations;
    now.scan_complete = false;
  });
  CommandArguments none("{}");
  return start_scan(none);
}

nlohmann::ordered_json Service::Implementation::start_reconstruct(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  ReconstructOptions options;
  options.fusion.voxel_mm = arguments.positive("voxel_mm").value_or(options.fusion.voxel_mm);
  arguments.check_all_read();
  options.decode.algorithm = opened().capture.algorithm;
  return started("reconstruct", [this, project, options](const Run& run) {
    const Reconstruction result = reconstruct(read_scan(project.scan, run), options, run);
    run.stage("files");
    make_folder(project.derived);
    std::error_code ignored;
    std::filesystem::remove(project.edits(), ignored);  // they belong to the mesh before
    write_mesh(project.surface(), result.mesh, {}, run);
    AtomicFile summary(project.summary());
    summary.stream() << summary_of(result);
    summary.commit();
    change([&](OpenProject& opened) { opened.summary = summary_of(result); });
    load_surface(project, run);
    if (!result.untrusted_reason.empty())
      run.warn("do not trust this surface: " + result.untrusted_reason);
    refresh_projects();
  });
}
}  // namespace frangia
