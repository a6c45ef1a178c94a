#include "frangia/exchange/rig_from_calibration.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

[[noreturn]] void fail_import(const std::string& sentence) {
  throw Error(ErrorKind::Input, sentence);
}

/// The sentence about what is missing, with the names that could be it.
[[noreturn]] void fail_missing(const ForeignCalibration& calibration, std::string sentence) {
  if (!calibration.unknown.empty()) {
    sentence += fmt::format(". The files also hold {}: say which one is what by `map`",
                            fmt::join(calibration.unknown, ", "));
  }
  fail_import(sentence);
}

/// Files carry six digits and more.
constexpr double kRotationTolerance = 1e-4;

/// Pixels are squares, or those of a projector that are twice as wide as high, or half.
void warn_of_focal_lengths(const CameraModel& model, const char* device, const Run& run) {
  constexpr double kUnequal = 0.05;   // share by which focal lengths of real devices do not differ
  constexpr double kNarrowest = 0.1;  // rad; a field of 6 degrees
  const double ratio = model.focal_px.x() / model.focal_px.y();
  const auto is_near = [&](double value) { return std::abs(ratio / value - 1.0) < kUnequal; };
  if (!is_near(1.0) && !is_near(2.0) && !is_near(0.5)) {
    run.warn(
        fmt::format("the focal lengths of the {}, {:.0f} and {:.0f} px, differ by {:.0f} %, "
                    "which no device has; calibrate it again",
                    device,
                    model.focal_px.x(),
                    model.focal_px.y(),
                    100.0 * std::abs(ratio - 1.0)));
  }
  const double field =
      std::max(model.width_px / model.focal_px.x(), model.height_px / model.focal_px.y());
  if (field < kNarrowest) {
    run.warn(
        fmt::format("the focal length of the {}, {:.0f} px, gives a field of {:.1f} degrees "
                    "only; check it and the size, or calibrate again",
                    device,
                    model.focal_px.maxCoeff(),
                    deg_from_rad(field)));
  }
}

void warn_of_distortion(const CameraModel& model, const char* device, const Run& run) {
  constexpr double kLargest = 0.4;  // of the distance from the axis; webcams have 0.3
  double largest = 0.0;
  for (const double x : {0.0, static_cast<double>(model.width_px)}) {
    for (const double y : {0.0, static_cast<double>(model.height_px)}) {
      const Eigen::Vector2d pixel(x, y);
      const Eigen::Vector2d straight = model.ray(pixel);
      if (straight.hasNaN()) {
        run.warn(
            fmt::format("the distortion of the {} folds back at a corner of the image, where no "
                        "point is measured",
                        device));
        return;
      }
      const Eigen::Vector2d distorted =
          (pixel - model.principal_point_px).cwiseQuotient(model.focal_px);
      largest = std::max(largest, (distorted - straight).norm() / straight.norm());
    }
  }
  if (largest > kLargest) {
    run.warn(
        fmt::format("the distortion of the {} displaces a corner of its image by {:.0f} %, "
                    "more than a lens has; calibrate it again",
                    device,
                    100.0 * largest));
  }
}

CameraModel imported_model_of(const ForeignLens& lens,
                              const std::optional<std::array<int, 2>>& given_size,
                              const char* device,
                              const Run& run) {
  const auto size = given_size ? given_size : lens.size_px;
  if (!size) {
    fail_import(
        fmt::format("the calibration states no image size of the {0}; set `{0}_size`", device));
  }
  const Eigen::Matrix3d& matrix = *lens.matrix;
  const bool is_pinhole = matrix.allFinite() && matrix(0, 0) > 0.0 && matrix(1, 1) > 0.0 &&
                          matrix(1, 0) == 0.0 && matrix.row(2) == Eigen::RowVector3d(0, 0, 1);
  if (!is_pinhole) {
    fail_import(fmt::format(
        "the matrix of the {} is not a camera matrix, [fx 0 cx; 0 fy cy; 0 0 1]", device));
  }
  constexpr double kMaxSkew = 1e-6;  // of the focal length
  if (std::abs(matrix(0, 1)) > kMaxSkew * matrix(0, 0)) {
    fail_import(
        fmt::format("the matrix of the {} has a skew of {:.4g} px, which no rig can hold; "
                    "calibrate without skew",
                    device,
                    matrix(0, 1)));
  }
  CameraModel model;
  model.width_px = (*size)[0];
  model.height_px = (*size)[1];
  model.focal_px = {matrix(0, 0), matrix(1, 1)};
  model.principal_point_px = {matrix(0, 2), matrix(1, 2)};
  if (lens.distortion.size() > model.distortion.size()) {
    fail_import(
        fmt::format("the {} has {} distortion coefficients; OpenCV's models have 14 at most",
                    device,
                    lens.distortion.size()));
  }
  // Three may be k1 k2 k3, or k1 k2 p1: what else others count is not known.
  constexpr std::array<std::size_t, 8> kCounts{0, 1, 2, 4, 5, 8, 12, 14};
  const bool all_zero = std::all_of(lens.distortion.begin(),
                                    lens.distortion.end(),
                                    [](double coefficient) { return coefficient == 0.0; });
  if (!all_zero &&
      std::find(kCounts.begin(), kCounts.end(), lens.distortion.size()) == kCounts.end()) {
    fail_import(
        fmt::format("the {} has {} distortion coefficients; OpenCV's models have 4, 5, 8, 12 or "
                    "14: k1 k2 p1 p2 k3 ..., with 0 for those that it does not have",
                    device,
                    lens.distortion.size()));
  }
  for (std::size_t i = 0; i < lens.distortion.size(); ++i) {
    if (!std::isfinite(lens.distortion[i]))
      fail_import(fmt::format("a distortion coefficient of the {} is not a number", device));
    model.distortion.at(i) = lens.distortion[i];
  }
  warn_of_focal_lengths(model, device, run);
  const Eigen::Vector2d corner(model.width_px, model.height_px);
  const Eigen::Vector2d center = model.principal_point_px.cwiseQuotient(corner);
  // A projector's principal point may lie beyond its lower edge, since it projects upwards.
  const double beyond = std::string_view(device) == "projector" ? 0.5 : 0.0;
  if (center.minCoeff() < -beyond || center.maxCoeff() > 1.0 + beyond) {
    run.warn(
        fmt::format("the principal point of the {}, ({:.0f}, {:.0f}) px, lies outside its "
                    "{} x {} pixels; check the size",
                    device,
                    model.principal_point_px.x(),
                    model.principal_point_px.y(),
                    model.width_px,
                    model.height_px));
  }
  warn_of_distortion(model, device, run);
  return model;
}

/// Whether a point of the camera's field, 0.3 to 100 baselines away, is seen by the other device,
/// and from the same side: two rays that are nearly opposite meet no surface that both of them
/// light or see. Points are on a grid of 9 x 9 pixels and 24 distances.
bool sees_a_common_point(const CameraModel& camera,
                         const CameraModel& other,
                         const Eigen::Matrix3d& rotation,
                         const Eigen::Vector3d& position_mm) {
  constexpr int kPixels = 9;
  constexpr int kDistances = 24;
  constexpr double kOpposite = -0.5;  // cosine of 120 degrees: each ray is 60 from the normal
  constexpr double kStep = 1.288;     // 0.3 baselines times its power of 23 are 100 baselines
  for (int i = 0; i < kPixels * kPixels; ++i) {
    const Eigen::Vector2d pixel(camera.width_px * (i % kPixels) / (kPixels - 1.0),
                                camera.height_px * (i / kPixels) / (kPixels - 1.0));
    const Eigen::Vector3d ray = camera.ray(pixel).homogeneous();
    if (ray.hasNaN()) continue;
    double distance_mm = 0.3 * position_mm.norm();
    for (int k = 0; k < kDistances; ++k, distance_mm *= kStep) {
      const Eigen::Vector3d point = rotation * (distance_mm * ray - position_mm);
      if (!(point.z() > 0.0)) continue;
      if ((rotation * ray).normalized().dot(point.normalized()) < kOpposite) continue;
      const Eigen::Vector2d at = other.project(point);
      if (at.minCoeff() >= 0.0 && at.x() <= other.width_px && at.y() <= other.height_px)
        return true;
    }
  }
  return false;
}

void warn_without_common_point(const CameraModel& camera,
                               const CameraModel& other,
                               const Eigen::Matrix3d& rotation,
                               const Eigen::Vector3d& position_mm,
                               const char* device,
                               const Run& run) {
  if (sees_a_common_point(camera, other, rotation, position_mm)) return;
  const bool inverse_fits =
      sees_a_common_point(camera, other, rotation.transpose(), rotation * position_mm * -1.0);
  const double turn_deg = deg_from_rad(std::acos(std::clamp(rotation(2, 2), -1.0, 1.0)));
  run.warn(
      fmt::format("the camera and the {} see no common point: their axes are {:.0f} degrees "
                  "apart{}; calibrate again",
                  device,
                  turn_deg,
                  inverse_fits ? ", and R and T fit only as those from the other device to the "
                                 "camera"
                               : ""));
}

/// Pose of the second device in the frame of the first.
struct ImportedPose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d position_mm;
};

ImportedPose imported_pose(const ForeignCalibration& calibration,
                           const ImportRigOptions& options,
                           const Run& run) {
  const Eigen::Matrix3d& rotation = *calibration.rotation;
  const double departure = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(departure < kRotationTolerance) || rotation.determinant() < 0.0)
    fail_import("R of the calibration is not a rotation matrix");
  const double scale = options.mm_per_unit.value_or(calibration.mm_per_unit);
  const Eigen::Vector3d translation_mm = scale * *calibration.translation;
  if (!translation_mm.allFinite() || translation_mm.norm() == 0.0)
    fail_import("T of the calibration is 0 or not a number; triangulation needs a baseline");
  constexpr double kShortest_mm = 3.0;
  if (!options.mm_per_unit && translation_mm.norm() < kShortest_mm) {
    run.warn(fmt::format("the baseline is {:.4g} mm; if the calibration is in metres, set `unit`",
                         translation_mm.norm()));
  }
  ImportedPose pose;
  pose.rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  pose.position_mm = -(pose.rotation.transpose() * translation_mm);
  return pose;
}

/// Makes the second device of the calibration a camera of the rig, and the projector a label.
void set_second_camera(const ForeignCalibration& calibration,
                       const ImportRigOptions& options,
                       const Run& run,
                       Rig& rig) {
  if (!calibration.projector.matrix || !calibration.rotation || !calibration.translation) {
    fail_missing(
        calibration,
        "the calibration does not state the matrix of a second camera with R and T; name the file "
        "that holds them as well");
  }
  PosedCamera posed;
  posed.camera.name = options.second_camera;
  posed.camera.white_level = rig.reference().white_level;
  posed.camera.model =
      imported_model_of(calibration.projector, options.camera_size_px, "camera", run);
  const ImportedPose pose = imported_pose(calibration, options, run);
  posed.position_mm = pose.position_mm;
  posed.rotation = pose.rotation;
  warn_without_common_point(rig.reference().model,
                            posed.camera.model,
                            posed.rotation,
                            posed.position_mm,
                            "second camera",
                            run);
  rig.cameras = {rig.cameras.front(), posed};
  if (options.base) return;
  if (!options.projector_size_px) {
    fail_import(
        "a projector that labels the points of two cameras needs a size; set `projector_size`");
  }
  PinholeModel model;
  model.width_px = (*options.projector_size_px)[0];
  model.height_px = (*options.projector_size_px)[1];
  model.focal_px = model.principal_point_px = Eigen::Vector2d::Constant(std::nan(""));
  rig.projector.position_mm.setConstant(std::nan(""));
  rig.projector.rotation.setConstant(std::nan(""));
  rig.projector.model = model;
  rig.projector.is_label = true;
}

}  // namespace

Rig rig_from_calibration(const ForeignCalibration& calibration,
                         const ImportRigOptions& options,
                         const Run& run) {
  Rig rig = options.base.value_or(Rig{});
  if (!calibration.camera.matrix && !options.base) {
    fail_missing(
        calibration,
        "the calibration has no camera; name the file that holds its matrix as well, or set "
        "`base` to a rig.toml");
  }
  if (calibration.camera.matrix)
    rig.reference().model =
        imported_model_of(calibration.camera, options.camera_size_px, "camera", run);
  // What was known of the base's uncertainty is not true of the imported values.
  rig.calibration.reset();
  if (!options.second_camera.empty()) {
    set_second_camera(calibration, options, run, rig);
    return rig;
  }
  if (calibration.projector.matrix) {
    rig.projector.model =
        imported_model_of(calibration.projector, options.projector_size_px, "projector", run);
  } else if (!options.base) {
    fail_missing(
        calibration,
        "the calibration has a camera, but no projector; set `base` to a rig.toml that describes "
        "the projector");
  }
  if (calibration.rotation && calibration.translation) {
    const ImportedPose pose = imported_pose(calibration, options, run);
    rig.projector.rotation = pose.rotation;
    rig.projector.position_mm = pose.position_mm;
    if (const auto* model = std::get_if<PinholeModel>(&rig.projector.model)) {
      warn_without_common_point(
          rig.reference().model, *model, pose.rotation, pose.position_mm, "projector", run);
    }
  } else if (!options.base) {
    fail_missing(
        calibration,
        "the calibration does not state R and T from camera to projector; name the file that holds "
        "them as well, or set `base` to a rig.toml");
  }
  return rig;
}

}  // namespace frangia
