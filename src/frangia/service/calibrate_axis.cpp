#include "frangia/service/calibrate_axis.h"

#include <filesystem>

#include <fmt/format.h>

#include "frangia/acquisition/calibrate_capture.h"
#include "frangia/acquisition/capture_scan.h"
#include "frangia/calibrate/solve/calibrate_turntable.h"
#include "frangia/core/angles.h"
#include "frangia/core/folder_lock.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/reconstruct/find_turntable_axis.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/internal/opened_devices.h"
#include "frangia/simulate/default_patterns.h"

namespace frangia {
namespace {

constexpr int kViews = 7;
/// A board is seen by camera and projector within this turn, and the axis needs 20 degrees.
constexpr double kTurnDeg = 60.0;

void capture_turned_board(const Scan& plan,
                          const ProjectFolder& project,
                          const CaptureSettings& settings,
                          const CaptureSetup& setup,
                          const Run& run) {
  std::filesystem::remove_all(plan.folder);  // another search; the board may stand elsewhere
  const FolderLock lock(plan.folder);
  const SimulatedBoard simulated{
      .board = *plan.board, .poses = 1, .on_turntable = true, .turn_rad = rad_from_deg(kTurnDeg)};
  OpenedDevices opened(project.rig(), plan.rig, setup.board_drivers(simulated), setup, run);
  CalibrateCaptureOptions options;
  options.poses = kViews;
  options.capture.camera = settings.camera;
  run.stage("poses");
  static_cast<void>(calibrate_capture(plan, opened.devices(), lock, options, run));
}

void capture_turned_part(const Scan& plan,
                         const ProjectFolder& project,
                         const CaptureSettings& settings,
                         const CaptureSetup& setup,
                         const Run& run) {
  std::filesystem::remove_all(plan.folder);  // another search; another part may stand there
  const FolderLock lock(plan.folder);
  OpenedDevices opened(project.rig(), plan.rig, setup.drivers(), setup, run);
  CaptureOptions options;
  options.camera = settings.camera;
  run.stage("poses");
  const CaptureReport report = capture_scan(plan, opened.devices(), lock, options, run);
  if (!report.skipped.empty()) throw Error(ErrorKind::Device, report.skipped.front().sentence());
}

/// A scan whose views are kept until the next search.
Scan planned(const ProjectFolder& project, const Run& run) {
  Scan plan;
  plan.folder = project.axis();
  plan.name = "axis";
  plan.rig = read_rig(project.rig(), run);
  return plan;
}

}  // namespace

FoundAxis calibrate_axis(const ProjectFolder& project,
                         const Board& board,
                         const CaptureSettings& settings,
                         const CaptureSetup& setup,
                         const Run& run) {
  Scan plan = planned(project, run);
  plan.board = board;
  plan.patterns = calibration_patterns(plan.rig);
  for (int i = 0; i < kViews; ++i) {
    const double share = static_cast<double>(i) / (kViews - 1) - 0.5;
    plan.views.push_back({rad_from_deg(kTurnDeg) * share, fmt::format("views/{:03}", i), 0});
  }
  capture_turned_board(plan, project, settings, setup, run);
  run.stage("axis");
  const TurntableCalibration found = calibrate_turntable(
      read_scan(plan.folder, run, RigContent::StartValues), plan.rig, {}, 5.0, run);
  const TurntableSolution& solution = found.solution;
  keep_axis(project, solution.turntable, run);
  return {.views = found.views.size(),
          .axis_sigma_deg = deg_from_rad(solution.axis_sigma_rad),
          .point_sigma_mm = solution.point_sigma_mm,
          .angles_rms_deg = deg_from_rad(solution.angle_rms_rad),
          .distance_mm = solution.turntable.point_mm.norm()};
}

FoundAxis calibrate_axis_by_part(const ProjectFolder& project,
                                 const CaptureSettings& settings,
                                 const CaptureSetup& setup,
                                 const Run& run) {
  constexpr int kAround = 8;
  Scan plan = planned(project, run);
  plan.patterns = patterns_of(settings, plan.rig);
  for (int i = 0; i < kAround; ++i)
    plan.views.push_back({kTwoPi * i / kAround, fmt::format("views/{:03}", i), 0});
  capture_turned_part(plan, project, settings, setup, run);
  run.stage("axis");
  Scan scan = read_scan(plan.folder, run, RigContent::StartValues);
  scan.rig = plan.rig;
  const AxisOfPart found = find_turntable_axis(scan, {}, run);
  keep_axis(project, found.table, run);
  return figures_of(found);
}

}  // namespace frangia
