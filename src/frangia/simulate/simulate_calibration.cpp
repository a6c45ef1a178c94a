#include "frangia/simulate/simulate_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/dataset/write_scan.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/internal/simulated_scene.h"
#include "frangia/simulate/simulate_scan.h"

namespace frangia {
namespace {

constexpr std::uint64_t kPoseStream = 21;

/// Half of the sides of the printed sheet, mm: the squares and half a square of margin.
Eigen::Vector2d half_sheet(const Board& board) {
  return 0.5 * board.square_mm * Eigen::Vector2d(board.columns + 2.0, board.rows + 2.0);
}

bool is_inside(const CameraModel& model, const Eigen::Vector3d& point) {
  constexpr double kMargin = 0.02;  // of each side
  if (point.z() <= 0.0) return false;
  const Eigen::Vector2d pixel = model.project(point);
  const Eigen::Vector2d share(pixel.x() / (model.width_px - 1), pixel.y() / (model.height_px - 1));
  return share.minCoeff() > kMargin && share.maxCoeff() < 1.0 - kMargin;
}

/// Whether all cameras and the projector see all of the sheet, and not too obliquely.
bool is_visible(const Board& board,
                const Eigen::Isometry3d& rig_from_board,
                const Rig& rig,
                const PinholeModel& projector) {
  const Eigen::Vector2d half = half_sheet(board);
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) {
      const Eigen::Vector3d corner = rig_from_board * Eigen::Vector3d(x, y, 0.0);
      if (!is_inside(projector, rig.projector.from_rig(corner))) return false;
      for (const PosedCamera& posed : rig.cameras)
        if (!is_inside(posed.camera.model, posed.camera_from_rig() * corner)) return false;
    }
  }
  constexpr double kLeastCosine = 0.5;
  const Eigen::Vector3d normal = -rig_from_board.linear().col(2);
  const Eigen::Vector3d center = rig_from_board.translation();
  const auto faces = [&](const Eigen::Vector3d& viewer) {
    return normal.dot((viewer - center).normalized()) > kLeastCosine;
  };
  return faces(rig.projector.position_mm) &&
         std::all_of(rig.cameras.begin(), rig.cameras.end(), [&](const PosedCamera& posed) {
           return faces(posed.position_mm);
         });
}

/// A pose with a random tilt, turn and place; `stream` chooses it.
Eigen::Isometry3d random_pose(const Eigen::Vector3d& crossing,
                              double field_mm,
                              double max_tilt_rad,
                              std::uint64_t stream) {
  const auto even = [&](std::uint64_t index) {
    return 2.0 * uniform_from(hash(stream, index)) - 1.0;
  };
  const double direction = kPi * even(1);
  const double tilt = max_tilt_rad * std::sqrt(std::abs(even(2)));  // more poses with a large tilt
  constexpr double kMaxTurn_rad = 0.35;
  constexpr double kSideways = 0.15;  // of the field
  constexpr double kDepth = 0.3;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      (Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0)) *
       Eigen::AngleAxisd(kMaxTurn_rad * even(3), Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  pose.translation() =
      crossing +
      field_mm * Eigen::Vector3d(kSideways * even(4), kSideways * even(5), kDepth * even(6));
  return pose;
}

std::vector<Eigen::Isometry3d> choose_poses(const CalibrationPlan& plan,
                                            const PinholeModel& projector,
                                            double field_mm,
                                            std::uint64_t seed) {
  const Eigen::Vector3d crossing = crossing_of_axes(plan.rig);
  constexpr int kTries = 10'000;
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < kTries && static_cast<int>(poses.size()) < plan.poses; ++i) {
    const Eigen::Isometry3d pose =
        random_pose(crossing,
                    field_mm,
                    plan.max_tilt_rad,
                    hash(hash(seed, kPoseStream), static_cast<std::uint64_t>(i)));
    if (is_visible(plan.board, pose, plan.rig, projector)) poses.push_back(pose);
  }
  if (static_cast<int>(poses.size()) < plan.poses) {
    throw Error(
        ErrorKind::Input,
        fmt::format("no {} poses show the whole board to all cameras and the projector; set a "
                    "`square` below {:g} mm",
                    plan.poses,
                    plan.board.square_mm));
  }
  return poses;
}

/// Angles of the turntable about 0 at which the views of a board on it are captured.
std::vector<double> table_angles_rad(const CalibrationPlan& plan) {
  std::vector<double> angles;
  for (int i = 0; i < plan.poses; ++i) {
    const double share = plan.poses > 1 ? static_cast<double>(i) / (plan.poses - 1) - 0.5 : 0.0;
    angles.push_back(plan.turn_rad * share);
  }
  return angles;
}

/// A pose of the board at table angle 0 from which camera and projector see it at all angles.
Eigen::Isometry3d choose_standing_pose(const CalibrationPlan& plan,
                                       const PinholeModel& projector,
                                       double field_mm,
                                       std::uint64_t seed) {
  const Eigen::Isometry3d object_from_rig = plan.rig.rig_from_object(0.0).inverse();
  const Eigen::Vector3d crossing = crossing_of_axes(plan.rig);
  constexpr std::uint64_t kTries = 10'000;
  for (std::uint64_t i = 0; i < kTries; ++i) {
    constexpr double kTilt_rad = 0.3;
    const Eigen::Isometry3d object_from_board =
        object_from_rig *
        random_pose(crossing, field_mm, kTilt_rad, hash(hash(seed, kPoseStream + 1), i));
    const std::vector<double> angles = table_angles_rad(plan);
    const bool visible = std::all_of(angles.begin(), angles.end(), [&](double angle) {
      return is_visible(
          plan.board, plan.rig.rig_from_object(angle) * object_from_board, plan.rig, projector);
    });
    if (visible) return object_from_board;
  }
  throw Error(ErrorKind::Input,
              fmt::format("no board on the turntable is seen whole at all angles; set a `square` "
                          "below {:g} mm",
                          plan.board.square_mm));
}

/// What a user knows before a calibration: sizes.
Rig sizes_of(const Rig& rig) {
  const Eigen::Vector2d unknown = Eigen::Vector2d::Constant(std::nan(""));
  Rig known = rig;
  const auto forget = [&](CameraModel& model) {
    model.focal_px = model.principal_point_px = unknown;
    model.distortion = {};
  };
  forget(std::get<PinholeModel>(known.projector.model));
  for (PosedCamera& posed : known.cameras) {
    forget(posed.camera.model);
    if (&posed == &known.cameras.front()) continue;
    posed.position_mm.setConstant(std::nan(""));
    posed.rotation.setConstant(std::nan(""));
  }
  known.projector.position_mm.setConstant(std::nan(""));
  known.projector.rotation.setConstant(std::nan(""));
  known.turntable.reset();
  known.laser_sheet.reset();
  return known;
}

}  // namespace

BoardPoses plan_board_poses(const CalibrationPlan& given, std::uint64_t seed) {
  CalibrationPlan plan = given;
  const auto* projector = std::get_if<PinholeModel>(&plan.rig.projector.model);
  require(projector != nullptr,
          "the rig's projector is angular, but a board calibrates a digital projector only");
  const Eigen::Vector3d crossing = crossing_of_axes(plan.rig);
  const CameraModel& camera = plan.rig.reference().model;
  const double field_mm = crossing.z() * std::min(camera.width_px / camera.focal_px.x(),
                                                  camera.height_px / camera.focal_px.y());
  if (plan.board.square_mm == 0.0) {
    constexpr double kShare = 0.6;  // of the field
    // Half millimetres, which text and binary numbers hold exactly.
    plan.board.square_mm =
        std::max(0.5, std::floor(2.0 * kShare * field_mm / (plan.board.rows + 2.0)) / 2.0);
  }
  check_board(plan.board);
  if (!plan.rig.turntable) plan.rig.turntable = Turntable{.point_mm = crossing};
  const Eigen::Isometry3d object_from_rig = plan.rig.rig_from_object(0.0).inverse();
  Scan scan;
  scan.folder = plan.folder;
  scan.name = name_of(plan.board.kind);
  scan.rig = plan.rig;
  scan.board = plan.board;
  scan.patterns = calibration_patterns(plan.rig, plan.patterns);
  if (plan.on_turntable) {
    const auto angles = table_angles_rad(plan);
    scan.part_poses[0] = choose_standing_pose(plan, *projector, field_mm, seed);
    for (std::size_t i = 0; i < angles.size(); ++i)
      scan.views.push_back({angles[i], fmt::format("views/{:03}", i), 0});
  } else {
    // Each pose is a setup of its own: a part pose with one view.
    const auto poses = choose_poses(plan, *projector, field_mm, seed);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      scan.part_poses[static_cast<int>(i)] = object_from_rig * poses[i];
      scan.views.push_back({0.0, fmt::format("views/{:03}", i), static_cast<int>(i)});
    }
  }
  return {std::move(scan), make_sheet(half_sheet(plan.board))};
}

Scan simulate_calibration(const CalibrationPlan& given,
                          const SimulateOptions& options,
                          const Run& run) {
  const BoardPoses plan = plan_board_poses(given, options.seed);
  SimulateOptions printed = options;
  printed.board = plan.scan.board;
  Scan written = simulate_scan(plan.plate, plan.scan, printed, run);
  Rig truth = written.rig;
  truth.turntable = given.rig.turntable;
  write_rig(given.folder / "truth-rig.toml", truth);
  written.rig = sizes_of(written.rig);
  for (ScanView& view : written.views)
    view.setup = 0;
  write_scan(written);
  return written;
}

}  // namespace frangia
