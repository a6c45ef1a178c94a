#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "frangia/acquisition/calibrate_capture.h"
#include "frangia/acquisition/preview.h"
#include "frangia/calibrate/board/find_board.h"
#include "frangia/calibrate/board/printed_boards.h"
#include "frangia/calibrate/report/calibration_report.h"
#include "frangia/calibrate/report/residual_maps.h"
#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/folder_lock.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/service/calibration_wizard.h"
#include "frangia/service/internal/opened_devices.h"
#include "frangia/service/rig_history.h"
#include "frangia/simulate/default_patterns.h"

namespace frangia {
namespace {

/// Rounded to what a picture can show, so that the text stays short.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}

/// The residuals of a calibration by pose and over the images, as docs/service-api.md describes
/// them. Maps of more than 4000 points are thinned.
std::string residuals_text(const RigCalibration& result) {
  constexpr std::size_t kMostArrows = 4000;
  constexpr double kPlace_px = 0.1;
  constexpr double kResidual_px = 1e-3;
  nlohmann::ordered_json json;
  json["poses"] = nlohmann::ordered_json::array();
  for (const PoseResiduals& pose : pose_residuals(result)) {
    json["poses"].push_back({{"name", pose.name},
                             {"camera_rms_px", pose.camera_rms_px},
                             {"projector_rms_px", pose.projector_rms_px},
                             {"distance_mm", pose.distance_mm},
                             {"tilt_deg", deg_from_rad(pose.tilt_rad)},
                             {"change_mm", pose.change_mm},
                             {"outlier", pose.is_outlier}});
  }
  json["maps"] = nlohmann::ordered_json::array();
  for (const ResidualMap& map : residual_maps(result)) {
    nlohmann::ordered_json entry{{"title", map.title},
                                 {"width", map.width},
                                 {"height", map.height},
                                 {"rms_px", map.rms},
                                 {"points", map.arrows.size()}};
    entry["arrows"] = nlohmann::ordered_json::array();
    const std::size_t step = map.arrows.size() / (kMostArrows + 1) + 1;
    for (std::size_t i = 0; i < map.arrows.size(); i += step) {
      const auto& [from, residual] = map.arrows[i];
      entry["arrows"].push_back({rounded(from.x(), kPlace_px),
                                 rounded(from.y(), kPlace_px),
                                 rounded(residual.x(), kResidual_px),
                                 rounded(residual.y(), kResidual_px)});
    }
    json["maps"].push_back(entry);
  }
  return json.dump();
}

Image<float> counts_of(const Frame& frame) {
  Image<float> counts(width_of(frame), height_of(frame));
  std::visit(
      [&](const auto& image) {
        std::copy(image.pixels().begin(), image.pixels().end(), counts.pixels().begin());
      },
      frame);
  return counts;
}

/// The pattern of a calibration that shows the board without fringes.
Pattern white_of(const Scan& plan) {
  const auto white = std::find_if(plan.patterns.begin(), plan.patterns.end(), [](const auto& one) {
    return one.kind == PatternKind::White;
  });
  require(white != plan.patterns.end(), "the patterns of a calibration have no white one");
  return *white;
}

/// What a simulated camera sees: the board, or of those that name themselves the smallest.
Board simulated_board(const WizardBoard& wanted) {
  if (wanted.described) return *wanted.described;
  Board board = printed_board("a5");
  board.square_mm *= wanted.scale;
  return board;
}

void enter(const PoseCoverage& coverage, WizardState& state) {
  state.coverage = coverage;
  state.field = coverage.field();
  state.sufficient = coverage.sufficient();
}

}  // namespace

CalibrationWizard::CalibrationWizard(ProjectFolder project, std::function<void()> on_change)
    : project_(std::move(project)),
      folder_(project_.calibration()),
      on_change_(std::move(on_change)) {}

void CalibrationWizard::capture_pose() {
  answer(Answer::Capture);
}

void CalibrationWizard::end_poses() {
  answer(Answer::End);
}

void CalibrationWizard::answer(Answer given) {
  {
    const std::lock_guard lock(mutex_);
    require(state_.waiting, "no pose of the board is waited for");
    answer_ = given;
    state_.waiting = false;
  }
  answered_.notify_all();
}

void CalibrationWizard::change(const std::function<void(WizardState&)>& edit) {
  {
    const std::lock_guard lock(mutex_);
    edit(state_);
  }
  on_change_();
}

/// Publishes a frame with the points of the board that it shows.
void CalibrationWizard::show(Frame frame, int white_level, const std::vector<BoardPoint>& points) {
  auto next = std::make_shared<LiveSnapshot>();
  for (const BoardPoint& point : points)
    next->corners_px.push_back(point.camera_px);
  next->white_level = white_level;
  next->frame = std::make_shared<const Frame>(std::move(frame));
  change([&](WizardState& state) {
    state.found = next->corners_px.size();
    next->revision = snapshot_ ? snapshot_->revision + 1 : 1;
    snapshot_ = next;
  });
}

/// Shows what the camera sees in white light until it is a printed board.
Board CalibrationWizard::wait_for_name(RigDevices& devices,
                                       const Scan& plan,
                                       const CameraSettings& camera,
                                       double scale,
                                       const Run& run) {
  change([](WizardState& state) { state.naming = true; });
  std::optional<Board> named;
  std::stop_source enough;
  const std::stop_callback by_user(run.stop, [&] { enough.request_stop(); });
  Run looking;
  looking.stop = enough.get_token();
  std::optional<PreviewSettings> settings{{.camera = camera, .patterns = {white_of(plan)}}};
  PreviewEvents events;
  events.next_settings = [&] { return std::exchange(settings, std::nullopt); };
  events.on_frame = [&](PreviewFrame seen) {
    const Image<float> counts = counts_of(seen.frame);
    named = recognize_printed_board(counts);
    show(std::move(seen.frame),
         devices.reference()->info().white_level,
         named ? find_board(counts, *named) : std::vector<BoardPoint>{});
    if (named) enough.request_stop();
  };
  try {
    preview(devices, plan.rig, events, looking);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Cancelled || !named) throw;
  }
  named->square_mm *= scale;
  change([&](WizardState& state) {
    state.naming = false;
    state.board = *named;
  });
  return *named;
}

/// Shows what the camera sees until somebody answers.
bool CalibrationWizard::wait_for_answer(RigDevices& devices,
                                        const Board& board,
                                        std::size_t number,
                                        const PoseCoverage& coverage,
                                        const Run& run) {
  change([&](WizardState& state) {
    enter(coverage, state);
    state.waiting = true;
    answer_ = Answer::None;
  });
  constexpr double kTimeout_s = 10.0;
  constexpr std::chrono::milliseconds kPause{200};
  for (int attempt = 0;; ++attempt) {
    run.check();
    CapturedFrame seen = devices.reference()->capture(
        {.view = static_cast<int>(number) - 1, .pattern = "white", .attempt = attempt},
        Deadline::in(kTimeout_s, run.stop));
    if (seen.complete) {
      const std::vector<BoardPoint> points = find_board(counts_of(seen.frame), board);
      show(std::move(seen.frame), devices.reference()->info().white_level, points);
    }
    std::unique_lock lock(mutex_);
    answered_.wait_for(lock, kPause, [&] { return answer_ != Answer::None; });
    if (answer_ != Answer::None) return std::exchange(answer_, Answer::None) == Answer::Capture;
  }
}

/// Returns the board that was captured.
Board CalibrationWizard::capture(const WizardBoard& wanted,
                                 std::size_t poses,
                                 const CaptureSettings& settings,
                                 const CaptureSetup& setup,
                                 const Run& run) {
  Scan plan;
  plan.folder = folder_;
  plan.name = "poses";
  plan.rig = read_rig(project_.rig(), run, RigContent::StartValues);
  plan.patterns = calibration_patterns(plan.rig);
  const FolderLock lock(plan.folder);
  const SimulatedBoard simulated{.board = simulated_board(wanted),
                                 .poses = static_cast<int>(poses)};
  OpenedDevices opened(project_.rig(), plan.rig, setup.board_drivers(simulated), setup, run);
  RigDevices& devices = opened.devices();
  run.stage("poses");
  const Board board = wanted.described
                          ? *wanted.described
                          : wait_for_name(devices, plan, settings.camera, wanted.scale, run);
  plan.board = board;
  CalibrateCaptureOptions options;
  options.poses = poses;
  options.capture.camera = settings.camera;
  options.wait_for_pose = [&](std::size_t number, const PoseCoverage& coverage) {
    return wait_for_answer(devices, board, number, coverage, run);
  };
  options.on_pose = [&](const CapturedPose& pose) {
    change([&](WizardState& state) {
      state.poses.push_back({pose.points, pose.expected});
      enter(pose.coverage, state);
    });
  };
  Run guided = run;
  guided.on_note = nullptr;  // the page shows the poses; the notes count the most that there may be
  static_cast<void>(calibrate_capture(plan, devices, lock, options, guided));
  return board;
}

/// Keeps what the page and a report show of a calibration.
void CalibrationWizard::keep(const RigCalibration& result, const Board& board) {
  write_text_file(project_.residuals(), residuals_text(result));
  make_folder(project_.exports());
  write_calibration_report(
      project_.exports() / "calibration.html", result, board, state().findings);
}

void CalibrationWizard::solve(const Board& board, const Run& run) {
  run.stage("calibrate");
  Run listening = run;
  listening.on_warning = [&](const std::string& sentence) {
    change([&](WizardState& state) { state.findings.push_back(sentence); });
    run.warn(sentence);
  };
  CalibrateRigOptions options;
  options.pose.keep_picture = true;
  const RigCalibration result =
      calibrate_rig(read_scan(folder_, listening, RigContent::StartValues), options, listening);
  keep_rig(project_, RigChange::Calibration);
  keep(result, board);
  const std::filesystem::path fresh = project_.in_folder("rig-calibrated.toml");
  write_rig(fresh, result.rig, Durability::Synced, project_.rig());
  std::filesystem::rename(fresh, project_.rig());
  const RigSolution& solution = result.solution;
  WizardVerdict verdict;
  verdict.grade = calibration_grade(solution);
  verdict.point_sigma_mm = solution.point_sigma_mm;
  verdict.spread_mm = solution.spread_mm;
  verdict.distance_mm = solution.distance_mm;
  verdict.baseline_mm = solution.projector_from_camera.translation().norm();
  verdict.camera_rms_px = solution.reference().residuals.rms_px;
  verdict.projector_rms_px = solution.reference().projector_residuals.rms_px;
  verdict.poses = result.views.size();
  change([&](WizardState& state) { state.verdict = verdict; });
}

void CalibrationWizard::run(const WizardBoard& board,
                            std::size_t poses,
                            const CaptureSettings& settings,
                            const CaptureSetup& setup,
                            const Run& run) {
  change([&](WizardState& state) {
    state = {};
    state.active = true;
    if (board.described) state.board = *board.described;
    state.wanted = poses;
  });
  struct AtEnd {
    CalibrationWizard& wizard;
    explicit AtEnd(CalibrationWizard& one) : wizard(one) {}
    AtEnd(const AtEnd&) = delete;
    AtEnd& operator=(const AtEnd&) = delete;
    AtEnd(AtEnd&&) = delete;
    AtEnd& operator=(AtEnd&&) = delete;
    ~AtEnd() {
      wizard.change(
          [](WizardState& state) { state.active = state.waiting = state.naming = false; });
    }
  };
  const AtEnd at_end(*this);
  try {
    solve(capture(board, poses, settings, setup, run), run);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Cancelled)
      change([&](WizardState& state) { state.fault = error.what(); });
    throw;
  }
}

}  // namespace frangia
