#include "frangia/exchange/write_calibration_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/text.h"

namespace frangia {
namespace {

/// The text that OpenCV's FileStorage writes for whole numbers and matrices, as XML for the ending
/// .xml and as YAML for any other.
std::string opencv_text(const std::vector<std::pair<std::string, Eigen::MatrixXd>>& matrices,
                        const std::vector<std::pair<std::string, int>>& numbers,
                        const std::string& ending) {
  // In memory, FileStorage takes the format from the ending of the name.
  cv::FileStorage storage(ending == ".xml" ? ".xml" : ".yml",
                          cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  for (const auto& [name, number] : numbers)
    storage << name << number;
  for (const auto& [name, matrix] : matrices) {
    cv::Mat copy(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), CV_64F);
    for (int row = 0; row < copy.rows; ++row) {
      for (int column = 0; column < copy.cols; ++column)
        copy.at<double>(row, column) = matrix(row, column);
    }
    storage << name << copy;
  }
  return storage.releaseAndGetString();
}

using nlohmann::ordered_json;

Eigen::Matrix3d camera_matrix_of(const CameraModel& model, double origin_px) {
  return Eigen::Matrix3d{{model.focal_px.x(), 0.0, model.principal_point_px.x() + origin_px},
                         {0.0, model.focal_px.y(), model.principal_point_px.y() + origin_px},
                         {0.0, 0.0, 1.0}};
}

/// Number of coefficients without the zeros at the end.
std::size_t used_coefficients(const CameraModel& model) {
  const auto last = std::find_if(
      model.distortion.rbegin(), model.distortion.rend(), [](double c) { return c != 0.0; });
  return static_cast<std::size_t>(model.distortion.rend() - last);
}

void require_coefficients(const CameraModel& model, std::size_t most, const char* program) {
  const std::size_t used = used_coefficients(model);
  if (used <= most) return;
  throw Error(
      ErrorKind::Input,
      fmt::format("{} holds {} distortion coefficients; this rig has {}", program, most, used));
}

Eigen::MatrixXd distortion_row(const CameraModel& model) {
  const std::size_t used = used_coefficients(model);
  const std::size_t count = used <= 5 ? 5 : used <= 8 ? 8 : used <= 12 ? 12 : 14;
  return Eigen::Map<const Eigen::RowVectorXd>(model.distortion.data(),
                                              static_cast<Eigen::Index>(count));
}

/// Names of the values in a file of OpenCV's FileStorage.
struct OpenCvNames {
  const char *camera_matrix, *camera_distortion, *projector_matrix, *projector_distortion,
      *rotation, *translation;
  std::array<const char*, 4> sizes;  ///< width, height of the camera, then of the projector
};

OpenCvNames keys_of(CalibrationLayout layout) {
  if (layout == CalibrationLayout::SlStudio) {
    return {"Kc",
            "kc",
            "Kp",
            "kp",
            "Rp",
            "Tp",
            {"frameWidth", "frameHeight", "screenResX", "screenResY"}};
  }
  const std::array<const char*, 4> sizes{
      "image_width", "image_height", "projector_width", "projector_height"};
  if (layout == CalibrationLayout::Scan3d)
    return {"cam_K", "cam_kc", "proj_K", "proj_kc", "R", "T", sizes};
  return {"M1", "D1", "M2", "D2", "R", "T", sizes};
}

std::string opencv_file(const Rig& rig,
                        const PinholeModel& projector,
                        CalibrationLayout layout,
                        const std::filesystem::path& file) {
  const OpenCvNames names = keys_of(layout);
  if (layout != CalibrationLayout::OpenCv) {
    const char* program = layout == CalibrationLayout::SlStudio ? "SLStudio" : "scan3d-capture";
    require_coefficients(rig.reference().model, 5, program);
    require_coefficients(projector, 5, program);
  }
  const Eigen::Vector3d translation = -(rig.projector.rotation * rig.projector.position_mm);
  const bool column = layout == CalibrationLayout::SlStudio;
  const auto distortion = [&](const CameraModel& model) -> Eigen::MatrixXd {
    return column ? Eigen::MatrixXd(distortion_row(model).transpose()) : distortion_row(model);
  };
  const CameraModel& camera = rig.reference().model;
  const std::vector<std::pair<std::string, Eigen::MatrixXd>> matrices{
      {names.camera_matrix, camera_matrix_of(camera, 0.0)},
      {names.camera_distortion, distortion(camera)},
      {names.projector_matrix, camera_matrix_of(projector, 0.0)},
      {names.projector_distortion, distortion(projector)},
      {names.rotation, rig.projector.rotation},
      {names.translation, translation}};
  const std::vector<std::pair<std::string, int>> sizes{{names.sizes[0], camera.width_px},
                                                       {names.sizes[1], camera.height_px},
                                                       {names.sizes[2], projector.width_px},
                                                       {names.sizes[3], projector.height_px}};
  return opencv_text(matrices, sizes, lowercase_extension(file));
}

ordered_json rows_of(const Eigen::MatrixXd& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    ordered_json values = ordered_json::array();
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      values.push_back(matrix(row, column));
    rows.push_back(std::move(values));
  }
  return rows;
}

ordered_json matlab_camera(const CameraModel& model) {
  require_coefficients(model, 5, "MATLAB");
  const auto& d = model.distortion;
  return {{"RadialDistortion", {d[0], d[1], d[4]}},
          {"TangentialDistortion", {d[2], d[3]}},
          {"ImageSize", {model.height_px, model.width_px}},
          {"WorldUnits", "millimeters"},
          {"IntrinsicMatrix", rows_of(camera_matrix_of(model, 1.0).transpose())}};
}

std::string matlab_file(const Rig& rig, const PinholeModel& projector) {
  const Eigen::Vector3d translation = -(rig.projector.rotation * rig.projector.position_mm);
  const ordered_json document{
      {"CameraParameters1", matlab_camera(rig.reference().model)},
      {"CameraParameters2", matlab_camera(projector)},
      {"RotationOfCamera2", rows_of(rig.projector.rotation.transpose())},
      {"TranslationOfCamera2", {translation.x(), translation.y(), translation.z()}}};
  return document.dump(2) + "\n";
}

std::string colmap_line(int id, const CameraModel& model) {
  require_coefficients(model, 8, "COLMAP");
  const auto& d = model.distortion;
  const bool full = used_coefficients(model) > 4;
  std::string line = fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}",
                                 id,
                                 full ? "FULL_OPENCV" : "OPENCV",
                                 model.width_px,
                                 model.height_px,
                                 model.focal_px.x(),
                                 model.focal_px.y(),
                                 model.principal_point_px.x() + 0.5,
                                 model.principal_point_px.y() + 0.5,
                                 d[0],
                                 d[1],
                                 d[2],
                                 d[3]);
  if (full) line += fmt::format(" {} {} {} {}", d[4], d[5], d[6], d[7]);
  return line + "\n";
}

std::string colmap_file(const Rig& rig, const PinholeModel& projector) {
  return "# Camera list with one line of data per camera:\n"
         "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
         "# 1: camera, 2: projector\n" +
         colmap_line(1, rig.reference().model) + colmap_line(2, projector);
}

}  // namespace

CalibrationLayout layout_of(const std::filesystem::path& file) {
  const std::string ending = lowercase_extension(file);
  if (ending == ".yml" || ending == ".yaml" || ending == ".xml") return CalibrationLayout::OpenCv;
  if (ending == ".json") return CalibrationLayout::Matlab;
  if (ending == ".txt") return CalibrationLayout::Colmap;
  throw Error(ErrorKind::Input,
              fmt::format("{}: a calibration is written as .yml, .yaml or .xml (OpenCV), .json "
                          "(MATLAB) or .txt (COLMAP)",
                          file.string()));
}

void write_calibration_file(const std::filesystem::path& file,
                            const Rig& rig,
                            CalibrationLayout layout,
                            Durability durability) {
  const auto* projector = std::get_if<PinholeModel>(&rig.projector.model);
  if (projector == nullptr) {
    throw Error(ErrorKind::Input,
                "the projector of the rig is angular; other programs describe pinhole projectors "
                "only");
  }
  const std::string text = layout == CalibrationLayout::Matlab ? matlab_file(rig, *projector)
                           : layout == CalibrationLayout::Colmap
                               ? colmap_file(rig, *projector)
                               : opencv_file(rig, *projector, layout, file);
  write_text_file(file, text, durability);
}

}  // namespace frangia
