#include "frangia/exchange/internal/interpret_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Names = std::initializer_list<const char*>;

// Those that `CalibrationNames` state come first; then the names that programs write.
constexpr Names kCameraMatrix{"=K1",
                              "Kc",
                              "cam_K",
                              "cam_int",
                              "M1",
                              "K1",
                              "cameraMatrix1",
                              "camera_matrix",
                              "cameraMatrix",
                              "mtx",
                              "Camera.Matrix",
                              "K"};
constexpr Names kCameraDistortion{"=D1",
                                  "kc",
                                  "cam_kc",
                                  "cam_dist",
                                  "D1",
                                  "d1",
                                  "distCoeffs1",
                                  "distortion_coefficients",
                                  "distCoeffs",
                                  "dist_coeffs",
                                  "dist",
                                  "Camera.Distortion",
                                  "D"};
constexpr Names kCameraSize{"cam_size", "image_size", "imageSize", "Camera.Size"};
constexpr Names kCameraWidth{"frameWidth", "image_width", "width"};
constexpr Names kCameraHeight{"frameHeight", "image_height", "height"};
constexpr Names kProjectorMatrix{"=K2",
                                 "Kp",
                                 "proj_K",
                                 "pro_K",
                                 "proj_int",
                                 "M4",
                                 "M2",
                                 "K2",
                                 "cameraMatrix2",
                                 "projector_matrix",
                                 "projMatrix",
                                 "Projector.Matrix"};
constexpr Names kProjectorDistortion{"=D2",
                                     "kp",
                                     "proj_kc",
                                     "pro_kc",
                                     "proj_dist",
                                     "D4",
                                     "D2",
                                     "d2",
                                     "distCoeffs2",
                                     "projector_distortion",
                                     "projDist",
                                     "Projector.Distortion"};
constexpr Names kProjectorSize{"proj_size", "pro_size", "Projector.Size"};
constexpr Names kProjectorWidth{"screenResX", "projector_width", "proj_width"};
constexpr Names kProjectorHeight{"screenResY", "projector_height", "proj_height"};
// Rlp is from the left camera to the projector, Rlr from the left camera to the right one.
constexpr Names kRotation{"=R", "Rp", "Rlp", "R", "rotation", "Rotation", "Rlr"};
constexpr Names kTranslation{"=T", "Tp", "Tlp", "T", "t", "translation", "Translation", "Tlr"};

/// The first of some names that the file holds; null without one.
const Eigen::MatrixXd* find_value(const NamedValues& values, Names names) {
  for (const char* name : names) {
    const auto found = values.matrices.find(name);
    if (found != values.matrices.end()) return &found->second;
  }
  return nullptr;
}

/// A matrix, or a list of its nine elements by rows.
std::optional<Eigen::Matrix3d> matrix3_of(const Eigen::MatrixXd* matrix) {
  if (matrix == nullptr) return std::nullopt;
  if (matrix->rows() == 1 && matrix->cols() == 9) {
    const Eigen::MatrixXd rows = rows_of_list(*matrix, 3, 3);
    return Eigen::Matrix3d(rows);
  }
  if (matrix->rows() != 3 || matrix->cols() != 3) return std::nullopt;
  return Eigen::Matrix3d(*matrix);
}

std::optional<Eigen::Vector3d> vector3_of(const Eigen::MatrixXd* matrix) {
  if (matrix == nullptr || matrix->size() != 3) return std::nullopt;
  return Eigen::Vector3d(matrix->reshaped());
}

std::vector<double> numbers_of(const Eigen::MatrixXd* matrix) {
  if (matrix == nullptr) return {};
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < matrix->size(); ++i)
    numbers.push_back(matrix->reshaped()[i]);
  return numbers;
}

/// Distortion coefficients.
///
/// @errors   Error(Input) for a matrix of several rows and columns
std::vector<double> distortion_of(const Eigen::MatrixXd* matrix) {
  if (matrix != nullptr && matrix->rows() > 1 && matrix->cols() > 1) {
    throw Error(
        ErrorKind::Input,
        fmt::format("a distortion is a matrix of {} x {}; it must be a list of coefficients",
                    matrix->rows(),
                    matrix->cols()));
  }
  return numbers_of(matrix);
}

/// A rotation matrix, or one by its rotation vector.
std::optional<Eigen::Matrix3d> rotation_of(const Eigen::MatrixXd* matrix) {
  if (const auto full = matrix3_of(matrix)) return full;
  const auto turn = vector3_of(matrix);
  if (!turn) return std::nullopt;
  if (turn->norm() == 0.0) return Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  return Eigen::AngleAxisd(turn->norm(), turn->normalized()).toRotationMatrix();
}

/// A side of an image in pixels; 0 when it is none.
int side_of(const Eigen::MatrixXd* matrix) {
  constexpr double kMaxSide = 65535.0;
  if (matrix == nullptr || matrix->size() != 1) return 0;
  const double side = (*matrix)(0, 0);
  return side >= 1.0 && side <= kMaxSide && side == std::floor(side) ? static_cast<int>(side) : 0;
}

std::optional<std::array<int, 2>> named_size_of(const NamedValues& values,
                                                Names widths,
                                                Names heights) {
  const int width = side_of(find_value(values, widths));
  const int height = side_of(find_value(values, heights));
  if (width == 0 || height == 0) return std::nullopt;
  return std::array<int, 2>{width, height};
}

/// The size of an image by one value, width and height, or by two values.
std::optional<std::array<int, 2>> size_of_values(const NamedValues& values,
                                                 Names sizes,
                                                 Names widths,
                                                 Names heights) {
  const Eigen::MatrixXd* size = find_value(values, sizes);
  if (size == nullptr || size->size() != 2) return named_size_of(values, widths, heights);
  const Eigen::MatrixXd width = Eigen::MatrixXd::Constant(1, 1, size->reshaped()[0]);
  const Eigen::MatrixXd height = Eigen::MatrixXd::Constant(1, 1, size->reshaped()[1]);
  if (side_of(&width) == 0 || side_of(&height) == 0) return std::nullopt;
  return std::array<int, 2>{side_of(&width), side_of(&height)};
}

/// Whether programs use a name, also one of ROS that states nothing more.
bool is_known(const std::string& name) {
  if (name == "rectification_matrix" || name == "projection_matrix") return true;
  for (const Names& names : {kCameraMatrix,
                             kCameraDistortion,
                             kCameraSize,
                             kProjectorMatrix,
                             kProjectorDistortion,
                             kProjectorSize,
                             kRotation,
                             kTranslation}) {
    if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  }
  return false;
}

/// Values that have the size of a matrix, of distortion coefficients or of a translation, under
/// names that no program is known to use.
std::vector<std::string> unknown_names(const NamedValues& values) {
  constexpr std::size_t kMostNames = 12;
  std::vector<std::string> unknown;
  for (const auto& [name, matrix] : values.matrices) {
    if (is_known(name) || matrix.size() < 2 || matrix.size() > 16) continue;
    if (unknown.size() == kMostNames) break;
    unknown.push_back(fmt::format("{} ({} x {})", name, matrix.rows(), matrix.cols()));
  }
  return unknown;
}

/// MATLAB's names from the part that states what a value is, without outer structures.
NamedValues without_outer_names(const NamedValues& values) {
  const auto inner = [](const std::string& name) {
    for (const char* part : {"CameraParameters", "RotationOfCamera2", "TranslationOfCamera2"}) {
      const auto at = name.find(part);
      if (at != std::string::npos) return name.substr(at);
    }
    return name;
  };
  NamedValues inside;
  for (const auto& [name, matrix] : values.matrices)
    inside.matrices.emplace(inner(name), matrix);
  for (const auto& [name, text] : values.texts)
    inside.texts.emplace(inner(name), text);
  return inside;
}

/// One of the two cameras of MATLAB's stereoParameters. Its first pixel has its centre at (1, 1),
/// and its older matrix is transposed.
ForeignLens matlab_camera_of(const NamedValues& values, const std::string& name) {
  const auto named = [&](const char* part) {
    return find_value(values, {(name + "." + part).c_str()});
  };
  ForeignLens lens;
  lens.matrix = matrix3_of(named("K"));
  if (!lens.matrix) {
    lens.matrix = matrix3_of(named("IntrinsicMatrix"));
    if (lens.matrix) lens.matrix->transposeInPlace();
  }
  const std::vector<double> focal = numbers_of(named("FocalLength"));
  const std::vector<double> center = numbers_of(named("PrincipalPoint"));
  if (!lens.matrix && focal.size() == 2 && center.size() == 2) {
    const std::vector<double> skew = numbers_of(named("Skew"));
    lens.matrix = Eigen::Matrix3d{{focal[0], skew.empty() ? 0.0 : skew[0], center[0]},
                                  {0.0, focal[1], center[1]},
                                  {0.0, 0.0, 1.0}};
  }
  if (lens.matrix) {
    (*lens.matrix)(0, 2) -= 1.0;
    (*lens.matrix)(1, 2) -= 1.0;
  }
  const std::vector<double> radial = numbers_of(named("RadialDistortion"));
  std::vector<double> tangential = numbers_of(named("TangentialDistortion"));
  if (radial.size() >= 2 && radial.size() <= 3) {
    tangential.resize(2);
    lens.distortion = {radial[0], radial[1], tangential[0], tangential[1]};
    if (radial.size() == 3) lens.distortion.push_back(radial[2]);
  }
  const std::vector<double> size = numbers_of(named("ImageSize"));  // rows, columns
  if (size.size() == 2 && size[0] >= 1.0 && size[1] >= 1.0 && size[0] < 65536.0 &&
      size[1] < 65536.0)
    lens.size_px = std::array<int, 2>{static_cast<int>(size[1]), static_cast<int>(size[0])};
  return lens;
}

/// One of the two cameras of Bouguet's toolbox, whose first pixel has its centre at (0, 0).
ForeignLens toolbox_camera_of(const NamedValues& values, const std::string& side) {
  const auto named = [&](const char* part) {
    return numbers_of(find_value(values, {(part + side).c_str()}));
  };
  ForeignLens lens;
  const std::vector<double> focal = named("fc");
  const std::vector<double> center = named("cc");
  const std::vector<double> skew = named("alpha_c");
  if (focal.size() == 2 && center.size() == 2) {
    lens.matrix = Eigen::Matrix3d{{focal[0], skew.empty() ? 0.0 : skew[0] * focal[0], center[0]},
                                  {0.0, focal[1], center[1]},
                                  {0.0, 0.0, 1.0}};
  }
  lens.distortion = named("kc");
  return lens;
}

}  // namespace

ForeignCalibration interpret_opencv_values(const NamedValues& values) {
  check_lens_models(values);
  ForeignCalibration found;
  found.program = find_value(values, {"Kc"}) != nullptr      ? "SLStudio"
                  : find_value(values, {"cam_K", "cam_int"}) ? "scan3d-capture"
                                                             : "OpenCV";
  found.camera.matrix = matrix3_of(find_value(values, kCameraMatrix));
  found.camera.distortion = distortion_of(find_value(values, kCameraDistortion));
  found.camera.size_px = size_of_values(values, kCameraSize, kCameraWidth, kCameraHeight);
  found.projector.matrix = matrix3_of(find_value(values, kProjectorMatrix));
  found.projector.distortion = distortion_of(find_value(values, kProjectorDistortion));
  found.projector.size_px =
      size_of_values(values, kProjectorSize, kProjectorWidth, kProjectorHeight);
  found.rotation = rotation_of(find_value(values, kRotation));
  found.translation = vector3_of(find_value(values, kTranslation));
  // scan3d-capture writes metres into its JSON, and millimetres into its YAML.
  if (find_value(values, {"cam_int"}) != nullptr) found.mm_per_unit = 1000.0;
  found.unknown = unknown_names(values);
  return found;
}

ForeignCalibration interpret_matlab_values(const NamedValues& all) {
  check_lens_models(all);
  const NamedValues values = without_outer_names(all);
  ForeignCalibration found;
  if (find_value(values, {"fc_left"}) != nullptr) {
    found.program = "the Camera Calibration Toolbox";
    found.camera = toolbox_camera_of(values, "_left");
    found.projector = toolbox_camera_of(values, "_right");
    found.camera.size_px = named_size_of(values, {"nx"}, {"ny"});
    found.rotation = rotation_of(find_value(values, {"om", "R"}));
    found.translation = vector3_of(find_value(values, {"T"}));
    return found;
  }
  found.program = "MATLAB";
  found.camera = matlab_camera_of(values, "CameraParameters1");
  found.projector = matlab_camera_of(values, "CameraParameters2");
  if (const auto rotation = matrix3_of(find_value(values, {"RotationOfCamera2"})))
    found.rotation = rotation->transpose();  // MATLAB multiplies rows: [x2] = [x1] R + t
  found.translation = vector3_of(find_value(values, {"TranslationOfCamera2"}));
  const auto unit = values.texts.find("CameraParameters1.WorldUnits");
  if (unit != values.texts.end()) {
    const std::string& name = unit->second;
    if (name == "cm" || name == "centimeters") found.mm_per_unit = 10.0;
    if (name == "m" || name == "meters") found.mm_per_unit = 1000.0;
    if (name == "in" || name == "inches") found.mm_per_unit = 25.4;
  }
  return found;
}

}  // namespace frangia
