#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/core/make_folder.h"
#include "frangia/files/write_mesh.h"
#include "frangia/pipeline/reconstruct.h"
#include "frangia/service/encode_arrays.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {
namespace {

/// Of each setup, for the picture of how they join: a millimetre apart on a part of a hand's size.
constexpr std::size_t kPointsOfSetup = 60'000;

/// What the registration did to the turntable, for pages that word it themselves. `plain` where
/// these figures say everything that its own words do.
nlohmann::ordered_json json_of_turntable(const RegistrationReport& report) {
  return {{"plain", report.untrusted_reason().empty() && report.undetermined.empty()},
          {"kept", report.kept_rig},
          {"overlap", report.overlap},
          {"moved_mm", report.axis_moved_mm()},
          {"turned_deg", deg_from_rad(report.axis_turned_rad())},
          {"angles_deg", deg_from_rad(report.largest_turn_rad())},
          {"closure_deg", std::abs(deg_from_rad(report.closure_after_rad))}};  // NaN: null
}

/// Figures of a reconstruction, as surface.json keeps them.
std::string summary_of(const Reconstruction& result) {
  nlohmann::ordered_json json{{"points", result.points}, {"views", result.views}};
  if (result.registration) {
    json["registration"] = result.registration->text();
    json["rms_before_mm"] = result.registration->rms_before_mm;
    json["rms_after_mm"] = result.registration->rms_after_mm;
    json["turntable"] = json_of_turntable(*result.registration);
  }
  json["untrusted_reason"] = result.untrusted_reason;
  json["setups"] = nlohmann::ordered_json::array();
  for (const SetupJoin& join : result.setups) {
    const Eigen::AngleAxisd turn(join.part_pose.linear());
    json["setups"].push_back({{"number", join.number},
                              {"views", join.views},
                              {"joined", join.joined},
                              {"ambiguous", join.ambiguous},
                              {"turned_deg", deg_from_rad(turn.angle())},
                              {"moved_mm", join.part_pose.translation().norm()},
                              {"overlap", join.overlap},  // NaN is written as null
                              {"violation", join.free_space_violation}});
  }
  return json.dump();
}

/// Keeps the points of the joined setups, and none of an earlier reconstruction.
void write_setup_clouds(const ProjectFolder& project, const std::vector<PointCloud>& clouds) {
  std::error_code error;
  for (std::size_t i = clouds.size(); std::filesystem::remove(project.setup_cloud(i), error); ++i) {
  }
  if (!clouds.empty()) make_folder(project.derived / "clouds");
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    AtomicFile file(project.setup_cloud(i));
    file.stream() << encode_points(clouds[i], kPointsOfSetup);
    file.commit();
  }
}

/// A setup begins when the one before is done: the part cannot be turned back.
void require_setup_done(const std::vector<ProjectStation>& stations, int setup) {
  const auto missing = [&](const ProjectStation& station) {
    return station.setup == setup && station.state != StationState::Done &&
           station.state != StationState::Skipped;
  };
  require(!stations.empty() && std::none_of(stations.begin(), stations.end(), missing),
          "the present setup is not complete; finish its scan before the part is turned over");
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
  const int present = present_setup(stations);
  const auto of_present = static_cast<std::size_t>(
      std::count_if(stations.begin(), stations.end(), [&](const ProjectStation& station) {
        return station.setup == present;
      }));
  const int wanted = static_cast<int>(
      arguments.whole_or("setup", static_cast<std::size_t>(present), 0, kMostSetups));
  const std::size_t asked =
      arguments.whole_or("stations", of_present == 0 ? 8 : of_present, 1, kMostStations);
  CaptureSetup setup = options_.capture;
  if (const auto angle = arguments.number("table_deg")) setup.table_at_rad = rad_from_deg(*angle);
  arguments.check_all_read();
  require(can_scan, "this project has no rig with devices; create one to scan");
  std::error_code ignored;
  const bool begun = std::filesystem::exists(project.scan / "capture", ignored);
  if (wanted == present + 1) {
    require_setup_done(stations, present);
    const auto more = planned_stations(asked, wanted);
    stations.insert(stations.end(), more.begin(), more.end());
    write_stations(project, stations);
  } else {
    require(wanted == present, "setup: the part lies in another one; add the next, or go on");
    require(!begun || asked == of_present,
            "the scan has begun; its number of stations cannot change");
    if (asked != of_present) stations = planned_stations(asked);
  }
  change([&](OpenProject& opened) {
    opened.scan_begun = true;
    opened.stations = stations;
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
  require(before.stations[station].setup == present_setup(before.stations),
          "the part was turned over since this station was captured; capture it in a new setup");
  require_idle();
  std::vector<ProjectStation> stations = before.stations;
  stations[station] = {.angle_deg = stations[station].angle_deg, .setup = stations[station].setup};
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
  options.keep_points_of_setups = kPointsOfSetup;
  return started("reconstruct", [this, project, options](const Run& run) {
    const Reconstruction result = reconstruct(read_scan(project.scan, run), options, run);
    run.stage("files");
    make_folder(project.derived);
    std::error_code ignored;
    std::filesystem::remove(project.edits(), ignored);  // they belong to the mesh before
    write_mesh(project.surface(), result.mesh, {}, run);
    write_setup_clouds(project, result.setup_points);
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
