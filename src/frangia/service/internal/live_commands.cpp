#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "frangia/acquisition/find_exposures.h"
#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/internal/opened_devices.h"

namespace frangia {
namespace {

/// The settings with those that the arguments name.
CaptureSettings with_arguments(CaptureSettings settings, CommandArguments& arguments) {
  settings.camera.exposure_ms =
      arguments.positive("exposure_ms").value_or(settings.camera.exposure_ms);
  settings.camera.gain_db = arguments.zero_or_more("gain_db").value_or(settings.camera.gain_db);
  settings.camera.black_level_counts =
      arguments.zero_or_more("black_level_counts").value_or(settings.camera.black_level_counts);
  settings.exposures_ms = arguments.list("exposures_ms", CaptureSettings::kMostExposures)
                              .value_or(settings.exposures_ms);
  settings.shifts = static_cast<int>(arguments.whole_or("shifts",
                                                        static_cast<std::size_t>(settings.shifts),
                                                        CaptureSettings::kFewestShifts,
                                                        CaptureSettings::kMostShifts));
  settings.algorithm = arguments.text_or("algorithm", settings.algorithm);
  settings.check();
  return settings;
}

LiveSettings live_arguments(LiveSettings settings, CommandArguments& arguments) {
  settings.pattern = arguments.named_or("pattern", settings.pattern);
  if (const auto angle = arguments.number("table_deg")) settings.table_rad = rad_from_deg(*angle);
  return settings;
}

}  // namespace

/// Settings of the scan. They are fixed once its first frame is stored.
nlohmann::ordered_json Service::Implementation::set_capture(CommandArguments& arguments) {
  const OpenProject project = opened();
  const CaptureSettings settings = with_arguments(project.capture, arguments);
  const std::size_t stations =
      arguments.whole_or("stations", project.stations.size(), 1, kMostStations);
  arguments.check_all_read();
  require(
      !project.scan_begun || (settings == project.capture && stations == project.stations.size()),
      "the scan has begun with its settings; create a project to scan with others");
  if (stations != project.stations.size()) {
    const auto planned = planned_stations(stations);
    write_stations(project.folder, planned);
    change([&](OpenProject& now) { now.stations = planned; });
  }
  if (!(settings == project.capture)) {
    make_folder(project.folder.derived);
    write_capture_settings(project.folder.capture(), settings);
    change([&](OpenProject& now) {
      now.capture = settings;
      now.check.reset();
    });
  }
  if (project.live) {
    LiveSettings live = project.live->settings();
    live.capture = settings;
    project.live->set(live);
  }
  return Json::object();
}

nlohmann::ordered_json Service::Implementation::set_live(CommandArguments& arguments) {
  const OpenProject project = opened();
  require(project.live != nullptr, "no preview runs; start it first");
  const LiveSettings settings = live_arguments(project.live->settings(), arguments);
  arguments.check_all_read();
  project.live->set(settings);
  change([](OpenProject&) {});
  return Json::object();
}

nlohmann::ordered_json Service::Implementation::start_live(CommandArguments& arguments) {
  const OpenProject project = opened();
  const LiveSettings settings = live_arguments({.capture = project.capture}, arguments);
  arguments.check_all_read();
  require_idle();
  return started_live(settings);
}

nlohmann::ordered_json Service::Implementation::started_live(const LiveSettings& settings) {
  const OpenProject project = opened();
  require(project.can_scan, "this project has no rig with devices; choose them in the step Rig");
  const std::optional<Rig>& rig = project.rig ? project.rig : project.start;
  require(rig.has_value(), project.rig_fault.c_str());
  const auto live = std::make_shared<LivePreview>(*rig, settings, [this] {
    if (options_.on_picture) options_.on_picture();
  });
  return started("live", [this, live, project](const Run& run) {
    run.stage("devices");
    OpenedDevices devices(
        project.folder.rig(), live->rig(), options_.capture.drivers(), options_.capture, run);
    // Another job may have changed the settings while this one waited.
    LiveSettings fresh = live->settings();
    fresh.capture = opened().capture;
    live->set(fresh);
    run.stage("preview");
    change([&](OpenProject& now) { now.live = live; });
    struct AtEnd {
      Implementation& service;
      explicit AtEnd(Implementation& one) : service(one) {}
      AtEnd(const AtEnd&) = delete;
      AtEnd& operator=(const AtEnd&) = delete;
      AtEnd(AtEnd&&) = delete;
      AtEnd& operator=(AtEnd&&) = delete;
      ~AtEnd() {
        service.change([](OpenProject& now) { now.live.reset(); });
      }
    };
    const AtEnd at_end(*this);
    live->run(devices.devices(), run);
  });
}

/// The exposure of the scan by the part as it stands. A preview that runs gives way and returns.
nlohmann::ordered_json Service::Implementation::start_find_exposure(CommandArguments& arguments) {
  const bool bracket = arguments.flag("bracket");
  arguments.check_all_read();
  const OpenProject project = opened();
  require(project.can_scan, "this project has no rig with devices; choose them in the step Rig");
  require(!project.scan_begun,
          "the scan has begun with its settings; create a project to scan with others");
  const std::optional<Rig> rig = project.rig ? project.rig : project.start;
  require(rig.has_value(), project.rig_fault.c_str());
  require_idle();
  // Where the preview shows the part.
  const auto angle =
      project.live ? std::optional(project.live->settings().table_rad) : std::nullopt;
  Json job = started("exposure", [this, project, rig, bracket, angle](const Run& run) {
    run.stage("devices");
    OpenedDevices devices(
        project.folder.rig(), *rig, options_.capture.drivers(), options_.capture, run);
    run.stage("exposure");
    CaptureSettings settings = project.capture;
    settings.exposures_ms.clear();
    CaptureOptions options;
    options.camera = settings.camera;
    options.exposure = bracket ? ExposureChoice::Bracketed : ExposureChoice::Automatic;
    const std::vector<double> chosen =
        find_exposures(devices.devices(), *rig, patterns_of(settings, *rig), options, angle, run);
    settings.camera.exposure_ms = chosen.front();
    if (chosen.size() > 1) settings.exposures_ms = chosen;
    write_capture_settings(project.folder.capture(), settings);
    change([&](OpenProject& now) {
      now.capture = settings;
      now.check.reset();
    });
  });
  if (project.live) static_cast<void>(started_live(project.live->settings()));
  return job;
}

}  // namespace frangia
