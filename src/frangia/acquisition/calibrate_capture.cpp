#include "frangia/acquisition/calibrate_capture.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/calibrate/board/calibrate_measure_pose.h"
#include "frangia/core/error.h"
#include "frangia/dataset/read_frames.h"

namespace frangia {
namespace {

/// Measures each pose after its capture.
class PoseObserver {
 public:
  PoseObserver(const Scan& plan, const CalibrateCaptureOptions& options, const Run& run)
      : plan_(plan), options_(options), run_(run) {
    coverage_ = measure_pose_coverage(views_, *plan.board, plan.rig.reference().model);
  }

  void add(std::size_t view) {
    const std::string name = plan_.views[view].folder.generic_string();
    const PoseCapture pose = calibrate_measure_pose(
        read_frames(plan_, view, run_), *plan_.board, plan_.rig, name, {}, run_);
    views_.push_back(pose.view);
    if (pose.view.points.empty()) without_board_.push_back(name);
    coverage_ = measure_pose_coverage(views_, *plan_.board, plan_.rig.reference().model);
    if (!options_.on_pose) return;
    const auto expected = static_cast<std::size_t>(plan_.board->columns) *
                          static_cast<std::size_t>(plan_.board->rows);
    options_.on_pose({views_.size(), name, pose.view.points.size(), expected, coverage_});
  }

  /// Whether another pose is wanted and stands ready.
  [[nodiscard]] bool wait() const {
    if (coverage_.poses >= options_.poses) return false;
    return options_.wait_for_pose(views_.size() + 1, coverage_);
  }

  [[nodiscard]] const PoseCoverage& coverage() const { return coverage_; }
  [[nodiscard]] const std::vector<std::string>& without_board() const { return without_board_; }

 private:
  const Scan& plan_;
  const CalibrateCaptureOptions& options_;
  const Run& run_;
  std::vector<BoardView> views_;
  std::vector<std::string> without_board_;
  PoseCoverage coverage_;
};

}  // namespace

CalibrateCaptureReport calibrate_capture(const Scan& plan,
                                         RigDevices& devices,
                                         const FolderLock& lock,
                                         const CalibrateCaptureOptions& options,
                                         const Run& run) {
  if (!plan.board) throw Error(ErrorKind::Input, "the plan of a calibration needs a board");
  check_board(*plan.board);
  Scan real = plan;
  real.rig.calibration.reset();  // these poses are for another one; its covariance stays behind
  const bool by_hand = options.wait_for_pose != nullptr;
  if (by_hand) {
    require(options.poses >= 1 && options.poses <= kMaxPosesByHand,
            fmt::format("`poses` must be from 1 to {}", kMaxPosesByHand).c_str());
    // As many as the folder may ever hold, so that a later session may add poses.
    real.views.clear();
    for (std::size_t i = 0; i < kMaxPosesByHand; ++i)
      real.views.push_back({0.0, fmt::format("views/{:03}", i), 0});
    devices.turntable.reset();  // it stands still
  }
  Run own = run;
  if (by_hand && run.progress) {
    own.progress = [&](double done) {
      constexpr auto kAll = static_cast<double>(kMaxPosesByHand);
      run.progress(std::min(1.0, done * kAll / static_cast<double>(options.poses)));
    };
  }
  PoseObserver observer(real, options, own);
  CaptureOptions capture = options.capture;
  if (by_hand) capture.before_view = [&](std::size_t /*view*/) { return observer.wait(); };
  capture.after_view = [&](std::size_t view) { observer.add(view); };
  CalibrateCaptureReport report;
  report.capture = capture_scan(real, devices, lock, capture, own);
  report.coverage = observer.coverage();
  report.without_board = observer.without_board();
  return report;
}

}  // namespace frangia
