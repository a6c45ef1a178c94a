#include "frangia/simulate/simulate_artifact.h"

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
#include "frangia/geometry/transform_mesh.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/internal/simulated_scene.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/simulate_scan.h"

namespace frangia {
namespace {

constexpr std::uint64_t kScreenStream = 31;
constexpr std::uint64_t kStartStream = 32;

double field_of(const Rig& rig) {
  const CameraModel& camera = rig.reference().model;
  return crossing_of_axes(rig).z() *
         std::min(camera.width_px / camera.focal_px.x(), camera.height_px / camera.focal_px.y());
}

/// Tilted another way in each pose, so that the image is full of the screen.
Eigen::Isometry3d screen_pose(const ArtifactPlan& plan, std::uint64_t seed, int index) {
  const auto stream = hash(hash(seed, kScreenStream), static_cast<std::uint64_t>(index));
  const auto even = [&](std::uint64_t which) {
    return 2.0 * uniform_from(hash(stream, which)) - 1.0;
  };
  constexpr double kSideways = 0.1;  // of the field
  constexpr double kDepth = 0.6;
  constexpr double kMaxTurn_rad = 0.8;
  const double direction = kTwoPi * (index + 0.5 * even(1)) / plan.views;
  const double tilt = plan.max_tilt_rad * (0.8 + 0.2 * even(2));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      (Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0)) *
       Eigen::AngleAxisd(kMaxTurn_rad * even(3), Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  pose.translation() =
      crossing_of_axes(plan.rig) + field_of(plan.rig) * Eigen::Vector3d(kSideways * even(4),
                                                                        kSideways * even(5),
                                                                        kDepth * even(6));
  return pose;
}

std::vector<Pattern> screen_patterns(const Screen& screen, const PatternPlan& plan) {
  Rig display;
  display.projector.model =
      PinholeModel{.width_px = screen.width_px, .height_px = screen.height_px};
  std::vector<Pattern> patterns;
  for (const Pattern& columns : default_patterns(display, plan)) {
    if (columns.kind != PatternKind::Fringe) continue;
    Pattern rows = columns;
    rows.direction = FringeDirection::Horizontal;
    rows.period_px *= static_cast<double>(screen.height_px) / screen.width_px;
    patterns.push_back(columns);
    patterns.back().name = fmt::format("columns-{}", patterns.size() / 2);
    rows.name = fmt::format("rows-{}", patterns.size() / 2);
    patterns.push_back(rows);
  }
  for (Pattern& pattern : patterns)
    pattern.source = PatternSource::Screen;
  return patterns;
}

/// Fringes with an absolute phase, in both directions where the projector shows both, and the line
/// of a laser sheet.
std::vector<Pattern> table_patterns(const Rig& rig, const PatternPlan& plan) {
  Rig without_sheet = rig;
  without_sheet.laser_sheet.reset();
  std::vector<Pattern> patterns = default_patterns(without_sheet, plan);
  if (const auto* projector = std::get_if<PinholeModel>(&rig.projector.model)) {
    const double ratio = static_cast<double>(projector->height_px) / projector->width_px;
    for (std::size_t i = 0, count = patterns.size(); i < count; ++i) {
      Pattern across = patterns[i];
      if (across.kind != PatternKind::Fringe) continue;
      across.name += "-rows";
      across.direction = FringeDirection::Horizontal;
      across.period_px *= ratio;
      patterns.push_back(across);
    }
  }
  if (rig.laser_sheet) patterns.push_back({.name = "line", .kind = PatternKind::Line});
  return patterns;
}

/// Turns the artifact about the turntable's axis, so that its x axis faces camera and projector at
/// table angle 0.
Mesh facing(const Mesh& part, const Rig& rig) {
  const Eigen::Isometry3d object_from_rig = rig.rig_from_object(0.0).inverse();
  const Eigen::Vector3d viewers = (object_from_rig * Eigen::Vector3d::Zero()).normalized() +
                                  (object_from_rig * rig.projector.position_mm).normalized();
  return transform_mesh(part,
                        Eigen::Isometry3d(Eigen::AngleAxisd(std::atan2(viewers.y(), viewers.x()),
                                                            Eigen::Vector3d::UnitZ())));
}

/// A sheet that leans back by 14 degrees beside the axis, with its face towards x. A shift along
/// the axis would leave an upright plate as it is.
Mesh standing_plate(double field_mm) {
  constexpr double kLean_rad = 0.25;
  const Eigen::Vector2d half(0.4 * field_mm, 0.35 * field_mm);
  Eigen::Isometry3d upright = Eigen::Isometry3d::Identity();
  upright.linear().col(0) = -Eigen::Vector3d::UnitY();
  upright.linear().col(1) = Eigen::Vector3d::UnitZ();
  upright.linear().col(2) = -Eigen::Vector3d::UnitX();
  upright.translation() = Eigen::Vector3d(0.0, 0.0, half.y());
  const Eigen::Isometry3d leaning(Eigen::Translation3d(0.03 * field_mm, 0.0, 0.0) *
                                  Eigen::AngleAxisd(-kLean_rad, Eigen::Vector3d::UnitY()));
  return transform_mesh(make_sheet(half), leaning * upright);
}

Mesh standing_part(const ArtifactPlan& plan) {
  if (std::holds_alternative<Plate>(plan.artifact)) return standing_plate(field_of(plan.rig));
  const auto& balls = std::get<Balls>(plan.artifact);
  const bool built_in = balls.spacing_mm && *balls.spacing_mm == 70.0 && balls.diameter_mm == 40.0;
  require(built_in, "the built-in ball bar has balls of 40 mm at a distance of 70 mm");
  return make_ball_bar();
}

/// The rig as it is known before: lengths and directions are off.
Rig roughly_known(const Rig& rig, const ArtifactPlan& plan, std::uint64_t seed) {
  const auto turned = [&](std::uint64_t which) {
    const std::uint64_t stream = hash(hash(seed, kStartStream), which);
    const Eigen::Vector3d about = {
        normal_from(hash(stream, 1)), normal_from(hash(stream, 2)), normal_from(hash(stream, 3))};
    return Eigen::AngleAxisd(plan.start_error_rad, about.normalized()).toRotationMatrix();
  };
  Rig rough = rig;
  rough.projector.position_mm *= 1.0 + plan.start_error;
  rough.projector.rotation = turned(1) * rig.projector.rotation;
  if (auto* angular = std::get_if<AngularModel>(&rough.projector.model)) {
    angular->pitch_scale *= 1.0 - plan.start_error;
    angular->wavefront = {};
  }
  rough.turntable->axis = turned(2) * rig.turntable->axis;
  rough.turntable->point_mm *= 1.0 - plan.start_error;
  if (rough.laser_sheet) {
    rough.laser_sheet->normal = turned(3) * rig.laser_sheet->normal;
    rough.laser_sheet->offset_mm *= 1.0 + plan.start_error;
  }
  return rough;
}

/// The rig of which the camera's size is known.
Rig camera_unknown(const Rig& rig) {
  Rig known = rig;
  known.reference().model.focal_px = known.reference().model.principal_point_px =
      Eigen::Vector2d::Constant(std::nan(""));
  known.reference().model.distortion = {};
  return known;
}

}  // namespace

Scan simulate_artifact(const ArtifactPlan& plan, const SimulateOptions& options, const Run& run) {
  check_artifact(plan.artifact);
  require(plan.rig.turntable.has_value(),
          "the rig has no [turntable], which carries the artifact; add it to rig.toml");
  const auto* screen = std::get_if<Screen>(&plan.artifact);
  Scan scan;
  scan.folder = plan.folder;
  scan.name = name_of(plan.artifact);
  scan.rig = plan.rig;
  scan.artifact = plan.artifact;
  scan.patterns = screen != nullptr ? screen_patterns(*screen, plan.patterns)
                                    : table_patterns(plan.rig, plan.patterns);
  const Eigen::Isometry3d object_from_rig = plan.rig.rig_from_object(0.0).inverse();
  for (int i = 0; i < plan.views; ++i) {
    const double share = plan.views > 1 ? static_cast<double>(i) / (plan.views - 1) - 0.5 : 0.0;
    const double angle_rad = screen != nullptr ? 0.0 : plan.turn_rad * share;
    scan.views.push_back({angle_rad, fmt::format("views/{:03}", i), screen != nullptr ? i : 0});
    if (screen != nullptr)
      scan.part_poses[i] = object_from_rig * screen_pose(plan, options.seed, i);
  }
  SimulateOptions shown = options;
  if (screen != nullptr) shown.screen = *screen;
  const Mesh part = screen != nullptr
                        ? make_sheet(0.5 * screen->pixel_mm *
                                     Eigen::Vector2d(screen->width_px, screen->height_px))
                        : facing(standing_part(plan), plan.rig);
  Scan written = simulate_scan(part, scan, shown, run);
  write_rig(plan.folder / "truth-rig.toml", written.rig);
  written.rig = roughly_known(written.rig, plan, options.seed);
  if (screen != nullptr) written.rig = camera_unknown(written.rig);
  for (ScanView& view : written.views)
    view.setup = 0;
  write_scan(written);
  return written;
}

}  // namespace frangia
