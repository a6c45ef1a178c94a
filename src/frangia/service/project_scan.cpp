#include "frangia/service/project_scan.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/acquisition/left_table.h"
#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/folder_lock.h"
#include "frangia/core/image.h"
#include "frangia/decode/decode_view.h"
#include "frangia/decode/triangulate_view.h"
#include "frangia/range/range_grid.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/reconstruct/watch_views.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig.h"
#include "frangia/service/encode_arrays.h"
#include "frangia/service/internal/opened_devices.h"
#include "frangia/service/internal/state_json.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

/// Triangulates decoded views of one rig, to be looked at while a scan grows.
class StationRange {
 public:
  explicit StationRange(const Rig& rig) : rig_(rig), rays_(rays_of(rig.reference().model)) {}

  /// The points of a view in the frame of the camera; empty when its phase does not fit the rig.
  [[nodiscard]] RangeGrid of(const DecodedView& decoded) const;
  /// The same at a turntable angle.
  ///
  /// @units    mm, object frame of the rig as calibrated
  [[nodiscard]] PointCloud cloud(const RangeGrid& range, double angle_rad) const;

 private:
  Rig rig_;
  Image<Eigen::Vector2f> rays_;
};

RangeGrid StationRange::of(const DecodedView& decoded) const {
  DecodedView view = decoded;
  const ViewFit fit = check_view(view, rig_, rays_, false);
  if (!fit.fits()) return {};
  return triangulate_view(view, fit, rig_, rays_, DirectionChoice::Fused).range;
}

PointCloud StationRange::cloud(const RangeGrid& range, double angle_rad) const {
  PointCloud cloud;
  const Eigen::Isometry3d object_from_rig = rig_.rig_from_object(angle_rad).inverse();
  for (int y = 0; y < range.depth_mm.height(); ++y) {
    for (int x = 0; x < range.depth_mm.width(); ++x) {
      const RangePixel pixel = range.pixel(x, y);
      if (std::isnan(pixel.depth_mm)) continue;
      const Eigen::Vector2f& ray = rays_(x, y);
      const Eigen::Vector3d point_mm =
          Eigen::Vector3f(ray.x(), ray.y(), 1.0F).cast<double>() * pixel.depth_mm;
      cloud.points_mm.emplace_back((object_from_rig * point_mm).cast<float>());
      cloud.sigma_mm.push_back(pixel.sigma_mm);
    }
  }
  return cloud;
}

constexpr std::size_t kMostCloudPoints = 60'000;  ///< of a station, for the picture

constexpr double kDegreesPerTurn = 360.0;

/// The stations of one capture, which two threads change.
class StationBook {
 public:
  StationBook(const ProjectFolder& project,
              std::vector<ProjectStation> stations,
              const std::function<void(const std::vector<ProjectStation>&)>& on_change)
      : project_(project), stations_(std::move(stations)), on_change_(on_change) {}

  void change(const std::function<void(std::vector<ProjectStation>&)>& edit) {
    const std::lock_guard lock(mutex_);
    edit(stations_);
    write_stations(project_, stations_);
    on_change_(stations_);
  }
  /// After a fault or a stop: the station that was being captured is captured again later.
  void wait_again() {
    try {
      change([](std::vector<ProjectStation>& stations) {
        for (ProjectStation& station : stations)
          if (station.state == StationState::Capturing) station.state = StationState::Waiting;
      });
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): the fault before says what is wrong
    }
  }
  /// The station that is captured when this share of the frames is stored.
  void at_share(double done) {
    const std::lock_guard lock(mutex_);
    const auto count = static_cast<double>(stations_.size());
    const auto present = static_cast<std::size_t>(std::min(done * count + 1e-9, count));
    if (present == present_ || present >= stations_.size()) return;
    present_ = present;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      StationState& state = stations_[i].state;
      if (i == present && state == StationState::Waiting) state = StationState::Capturing;
      if (i < present && state == StationState::Capturing) state = StationState::Done;
    }
    on_change_(stations_);
  }

 private:
  const ProjectFolder& project_;
  std::mutex mutex_;
  std::vector<ProjectStation> stations_;
  const std::function<void(const std::vector<ProjectStation>&)>& on_change_;
  std::size_t present_ = SIZE_MAX;
};

Scan plan_of(const ProjectFolder& project,
             const std::vector<ProjectStation>& stations,
             const CaptureSettings& settings,
             const Run& run) {
  Scan plan;
  plan.folder = project.scan;
  plan.name = project.name;
  plan.rig = read_rig(project.rig(), run);
  plan.patterns = patterns_of(settings, plan.rig);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    plan.views.push_back(
        {rad_from_deg(stations[i].angle_deg), fmt::format("views/{:03}", i), stations[i].setup});
  }
  return plan;
}

/// Stores what an assessment found, and the points of its view.
void enter(const ViewAssessment& found,
           const StationRange& ranges,
           GrowingSurface* growing,
           const ProjectFolder& project,
           StationBook& book,
           double angle_rad,
           bool is_placed) {
  bool has_cloud = false;
  if (found.decoded != nullptr && is_placed) {
    try {
      const RangeGrid range = ranges.of(*found.decoded);
      write_text_file(project.cloud(found.view),
                      encode_points(ranges.cloud(range, angle_rad), kMostCloudPoints));
      has_cloud = true;
      if (growing != nullptr && !range.depth_mm.empty()) growing->add(found.view, angle_rad, range);
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): the picture alone lacks these points
    }
  }
  book.change([&](std::vector<ProjectStation>& stations) {
    ProjectStation& station = stations.at(found.view);
    station.state = StationState::Done;
    station.verdict = found.verdict;
    station.good = found.good;
    station.contrast = found.contrast;
    station.saturated = found.saturated_fraction;
    station.points = found.points;
    station.has_cloud = has_cloud;
  });
}

/// What comparing a view with those before it says; empty where it cannot be compared.
std::string watched_finding(ViewWatch& watch,
                            const ViewAssessment& found,
                            const ScanView& view,
                            const Run& run) {
  try {
    return watch.compare(found.view, view.angle_rad, view.setup, *found.decoded, run).finding;
  } catch (const Error&) {  // the decoding reports faults of the frames
    return {};
  }
}

/// The table may have been turned by hand since the session that left it.
void require_table_angle(const ProjectFolder& project,
                         const RigDevices& devices,
                         const CaptureSetup& setup) {
  if (!devices.turntable || devices.turntable->info().can_home || setup.table_at_rad) return;
  if (const auto left = left_table(project.scan)) throw UnknownTableAngle(left->angle_deg);
}

}  // namespace

UnknownTableAngle::UnknownTableAngle(std::optional<double> last_deg)
    : Error(ErrorKind::Input,
            fmt::format("the turntable has no home switch and may have been turned since the scan "
                        "stopped{}; state its present angle, or turn it to 0 by hand and state 0",
                        last_deg ? fmt::format(" at {:.6g} degrees", *last_deg) : "")),
      last_deg_(last_deg) {}

std::vector<ProjectStation> planned_stations(std::size_t count, int setup) {
  std::vector<ProjectStation> stations(count);
  for (std::size_t i = 0; i < count; ++i) {
    stations[i].angle_deg = kDegreesPerTurn * static_cast<double>(i) / static_cast<double>(count);
    stations[i].setup = setup;
  }
  return stations;
}

int present_setup(const std::vector<ProjectStation>& stations) {
  return stations.empty() ? 0 : stations.back().setup;
}

void write_stations(const ProjectFolder& project, const std::vector<ProjectStation>& stations) {
  nlohmann::ordered_json json{{"format", "frangia-stations"}, {"version", 1}};
  json["stations"] = nlohmann::ordered_json::array();
  for (const ProjectStation& station : stations)
    json["stations"].push_back(json_of(station));
  write_text_file(project.stations(), json.dump(1) + "\n");
}

std::vector<ProjectStation> read_stations(const ProjectFolder& project, const Run& run) {
  std::vector<ProjectStation> stations;
  std::error_code ignored;
  if (std::filesystem::exists(project.stations(), ignored)) {
    try {
      const auto json = nlohmann::json::parse(project.read_json(project.stations().filename()));
      for (const auto& station : json.at("stations"))
        stations.push_back(station_from(station));
      return stations;
    } catch (const std::exception& fault) {
      run.warn(fmt::format("{}: is damaged and ignored ({})",
                           (project.derived / "stations.json").string(),
                           fault.what()));
      stations.clear();
    }
  }
  if (!std::filesystem::exists(project.in_scan("scan.toml"), ignored)) return stations;
  const Scan scan = read_scan(project.scan, run);
  for (const ScanView& view : scan.views) {
    ProjectStation station;
    station.angle_deg = deg_from_rad(view.angle_rad);
    station.setup = view.setup;
    station.state = StationState::Done;
    stations.push_back(station);
  }
  return stations;
}

DecodeOptions decode_options_of(const CaptureSettings& settings) {
  DecodeOptions options;
  options.algorithm = settings.algorithm;
  options.colors = ReconstructOptions{}.colors;
  options.keep_maps = false;
  return options;
}

std::shared_ptr<DecodedViews> views_to_keep(const ProjectFolder& project,
                                            const std::vector<ProjectStation>& stations,
                                            const CaptureSettings& settings,
                                            const std::shared_ptr<DecodedViews>& before,
                                            const Run& run) {
  const Scan plan = plan_of(project, stations, settings, run);
  const DecodeOptions options = decode_options_of(settings);
  if (!before || !before->fits(plan, options))
    return std::make_shared<DecodedViews>(plan, options, project.in_derived("plan"));
  before->forget_unsealed();
  return before;
}

std::vector<ProjectStation> place_clouds(const ProjectFolder& project,
                                         std::vector<ProjectStation> stations,
                                         const Turntable& table,
                                         const std::shared_ptr<const DecodedViews>& decoded) {
  if (!decoded) return stations;
  const Scan scan = read_scan(project.scan);
  Rig rig = scan.rig;
  rig.turntable = table;
  const StationRange ranges(rig);
  const std::vector<ScanView>& planned = decoded->scan().views;
  for (std::size_t view = 0; view < scan.views.size(); ++view) {
    const auto told = decoded->find(scan, decoded->options(), view);
    const auto of_station = std::find_if(planned.begin(), planned.end(), [&](const ScanView& one) {
      return one.folder == scan.views[view].folder;  // skipped stations are not in the scan
    });
    const auto station = static_cast<std::size_t>(of_station - planned.begin());
    if (!told || station >= stations.size()) continue;
    write_text_file(project.cloud(station),
                    encode_points(ranges.cloud(ranges.of(told->view), scan.views[view].angle_rad),
                                  kMostCloudPoints));
    stations[station].has_cloud = true;
  }
  write_stations(project, stations);
  return stations;
}

CaptureReport capture_project(
    const ProjectFolder& project,
    std::vector<ProjectStation> stations,
    const CaptureSettings& settings,
    const CaptureSetup& setup,
    const std::shared_ptr<DecodedViews>& decoded,
    const std::function<void(const std::vector<ProjectStation>&)>& on_change,
    GrowingSurface* growing,
    const Run& run) {
  run.stage("devices");
  const Scan plan = plan_of(project, stations, settings, run);
  make_folder(project.in_derived("clouds"));
  const FolderLock lock(plan.folder);
  OpenedDevices opened(project.rig(), plan.rig, setup.drivers(), setup, run);
  RigDevices& devices = opened.devices();
  require_table_angle(project, devices, setup);
  run.stage("scan");
  CaptureOptions options;
  options.camera = settings.camera;
  options.table_at_rad = setup.table_at_rad;
  options.setup = present_setup(stations);
  options.decoded = decoded;
  StationBook book(project, std::move(stations), on_change);
  const StationRange ranges(plan.rig);
  // Without the axis nothing says where a view belongs.
  const bool is_placed = plan.rig.turntable || plan.views.size() == 1;
  ViewWatch watch(plan.rig);
  options.check_view = [&](const ViewAssessment& found) {
    return watched_finding(watch, found, plan.views[found.view], run);
  };
  options.on_view = [&](const ViewAssessment& found) {
    enter(found, ranges, growing, project, book, plan.views[found.view].angle_rad, is_placed);
  };
  Run watched = run;
  watched.progress = [&](double done) {
    book.at_share(done);
    if (run.progress) run.progress(done);
  };
  book.at_share(0.0);
  CaptureReport report;
  try {
    report = capture_scan(plan, devices, lock, options, watched);
  } catch (...) {
    book.wait_again();
    throw;
  }
  book.change([&](std::vector<ProjectStation>& all) {
    for (ProjectStation& station : all)
      if (station.setup == options.setup) station.state = StationState::Done;
    for (const SkippedView& skipped : report.skipped) {
      all.at(skipped.view).state = StationState::Skipped;
      all.at(skipped.view).verdict = skipped.reason;
    }
  });
  return report;
}

}  // namespace frangia
