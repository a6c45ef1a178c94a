#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/decode/plan_decoding.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {
namespace {

/// A setup begins when the one before is done: the part cannot be turned back.
void require_setup_done(const std::vector<ProjectStation>& stations, int setup) {
  const auto missing = [&](const ProjectStation& station) {
    return station.setup == setup && station.state != StationState::Done &&
           station.state != StationState::Skipped;
  };
  require(!stations.empty() && std::none_of(stations.begin(), stations.end(), missing),
          "the present setup is not complete; finish its scan before the part is turned over");
}

/// The frames of a scan that came from elsewhere are not those of this project's devices.
void require_own_scan(const OpenProject& project) {
  require(!project.scan_complete || was_captured(project.folder),
          "this scan was opened, not captured here; create a project to scan with devices");
}

/// Refuses before the light a scan that cannot show the axis of its turntable.
void require_axis_can_show(const std::optional<Rig>& rig,
                           const CaptureSettings& settings,
                           std::size_t stations,
                           int setup) {
  constexpr std::size_t kFewestStations = 3;
  require(rig.has_value(), "calibrate the rig first; the axis needs camera and projector");
  require(stations >= kFewestStations && setup == 0,
          "stations: a scan shows the axis from three stations or more, better six or more");
  const DecodePlan plan =
      plan_decoding(patterns_of(settings, *rig), *rig, decode_options_of(settings));
  require(is_absolute(plan),
          "its fringe orders rest on the axis that is looked for; capture Gray code or coarser "
          "fringes, too");
}

}  // namespace

nlohmann::ordered_json Service::Implementation::start_scan(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  std::vector<ProjectStation> stations;
  bool can_scan = false;
  bool has_axis = false;
  std::optional<Rig> calibrated;
  CaptureSettings settings;
  {
    const std::lock_guard lock(mutex_);
    stations = project_->stations;
    can_scan = project_->can_scan;
    const std::optional<Rig>& rig = project_->rig ? project_->rig : project_->start;
    has_axis = !rig || rig->turntable.has_value();
    calibrated = project_->rig;
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
  const bool finds_axis = arguments.flag("find_axis") && !has_axis;
  CaptureSetup setup = options_.capture;
  if (const auto angle = arguments.number("table_deg")) setup.table_at_rad = rad_from_deg(*angle);
  arguments.check_all_read();
  require(can_scan, "this project has no rig with devices; create one to scan");
  require_own_scan(opened());
  if (finds_axis) {
    require_axis_can_show(calibrated, settings, asked, wanted);
  } else {
    require(has_axis || (asked == 1 && wanted == 0),
            "the axis of the turntable is unknown: find it in step Rig, or scan a single station");
  }
  const bool begun = was_captured(project);
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
    opened.grown.reset();
    opened.unknown_angle.reset();
    opened.axis_fault.clear();
  });
  return started("scan", [this, project, stations, settings, setup, finds_axis](const Run& run) {
    CaptureReport report;
    const auto decoded = views_to_keep(project, stations, settings, opened().decoded, run);
    change([&](OpenProject& opened) { opened.decoded = decoded; });
    // Each setup stands in its own pose on the table: the surface is that of the present one.
    std::optional<GrowingSurface> growing;
    if (const std::optional<Rig> rig = opened().rig) {
      growing.emplace(*rig, [this](const GrownSurface& grown) {
        change([&](OpenProject& opened) { opened.grown = grown; });
      });
    }
    try {
      report = capture_project(
          project,
          stations,
          settings,
          setup,
          decoded,
          [this](const std::vector<ProjectStation>& all) {
            change([&](OpenProject& opened) { opened.stations = all; });
          },
          growing ? &*growing : nullptr,
          run);
    } catch (const UnknownTableAngle& error) {
      change([&](OpenProject& opened) { opened.unknown_angle = error; });
      throw;
    }
    change([&](OpenProject& opened) { opened.scan_complete = true; });
    refresh_projects();
    if (finds_axis) find_axis_of_scan(project, run);
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
  require_own_scan(before);
  require(before.stations[station].setup == present_setup(before.stations),
          "the part was turned over since this station was captured; capture it in a new setup");
  require_idle();
  std::vector<ProjectStation> stations = before.stations;
  stations[station] = {.angle_deg = stations[station].angle_deg, .setup = stations[station].setup};
  write_stations(project, stations);  // if this fails, nothing has changed
  change([&](OpenProject& now) {
    now.stations = stations;
    now.scan_complete = false;
  });
  std::filesystem::remove(project.in_scan("scan.toml"));
  std::filesystem::remove_all(
      project.in_scan(std::filesystem::path("views") / fmt::format("{:03}", station)));
  const bool finds_axis = before.rig && !before.rig->turntable && before.stations.size() > 1;
  CommandArguments again(finds_axis ? R"({"find_axis": true})" : "{}");
  return start_scan(again);
}

/// What the part shows is no failure of the scan, whose frames are kept: the state says it.
void Service::Implementation::find_axis_of_scan(const ProjectFolder& project, const Run& run) {
  const OpenProject before = opened();
  run.stage("axis");
  try {
    const AxisOfPart found = axis_of_scan(project, before.capture, before.decoded, run);
    // Before the rig of the scan changes, for which the views were decoded.
    const std::vector<ProjectStation> stations =
        place_clouds(project, before.stations, found.table, before.decoded);
    keep_axis(project, found.table, run);
    change([&](OpenProject& now) {
      now.axis = figures_of(found);
      now.axis->of_scan = true;
      now.axis_fault.clear();
      now.stations = stations;
    });
    reload_rig(project);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Numeric && error.kind() != ErrorKind::Input) throw;
    const std::string about = project.scan.string() + ": ";  // the page shows one scan
    std::string fault = error.what();
    if (fault.starts_with(about)) fault.erase(0, about.size());
    change([&](OpenProject& now) { now.axis_fault = fault; });
  }
}

std::string Service::Implementation::cloud(std::size_t station) const {
  ProjectFolder project;
  {
    const std::lock_guard lock(mutex_);
    if (!project_ || station >= project_->stations.size() || !project_->stations[station].has_cloud)
      return {};
    project = project_->folder;
  }
  constexpr std::uint64_t kMostBytes = 16'000'000;
  return read_text_file(project.cloud(station), kMostBytes);
}
std::string Service::Implementation::grown_surface() const {
  const std::lock_guard lock(mutex_);
  return project_ && project_->grown ? *project_->grown->packed : std::string();
}

}  // namespace frangia
