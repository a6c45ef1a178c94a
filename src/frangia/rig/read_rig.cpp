#include "frangia/rig/read_rig.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/rig/internal/calibration_table.h"
#include "frangia/rig/rig_covariance.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

/// Largest deviation of a rotation or a unit vector from exact. Files carry nine digits; people
/// type four.
constexpr double kUnitTolerance = 2e-3;
constexpr int kMaxSide = 65535;  ///< px, as for frames

Eigen::Vector2d vector2(TomlReader& reader, std::string_view key) {
  const auto values = reader.numbers(key, 2);
  return {values[0], values[1]};
}

Eigen::Vector3d vector3(TomlReader& reader, std::string_view key) {
  const auto values = reader.numbers(key, 3);
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d direction(TomlReader& reader, std::string_view key) {
  const Eigen::Vector3d value = vector3(reader, key);
  if (std::abs(value.norm() - 1.0) > kUnitTolerance) {
    reader.fail(key, fmt::format("has length {:.6g}; it must be a unit vector", value.norm()));
  }
  return value.normalized();
}

/// A standard deviation, 0 or more; NaN is one that is not stated.
double not_negative(const TomlReader& reader, std::string_view key, double sigma) {
  if (sigma < 0.0) reader.fail(key, fmt::format("is {}; it must not be negative", sigma));
  return sigma;
}

Eigen::Matrix3d rotation(TomlReader& reader, std::string_view key) {
  const auto rows = reader.rows(key, 3, 3);
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix(row, column) = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
  }
  const double departure = (matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (departure > kUnitTolerance || matrix.determinant() < 0.0) {
    reader.fail(key,
                "is not a rotation: its rows must be the x, y and z axes in the rig frame, of unit "
                "length, perpendicular and right-handed");
  }
  return Eigen::Quaterniond(matrix).normalized().toRotationMatrix();
}

/// A model of which the size alone is known.
CameraModel read_image_size(TomlReader& reader) {
  CameraModel model;
  const auto size = reader.numbers("size_px", 2);
  for (const double side : size) {
    if (side < 1.0 || side > kMaxSide || side != std::floor(side)) {
      reader.fail("size_px", "must be two whole numbers, width and height, from 1 to 65535");
    }
  }
  model.width_px = static_cast<int>(size[0]);
  model.height_px = static_cast<int>(size[1]);
  model.focal_px = model.principal_point_px = Eigen::Vector2d::Constant(std::nan(""));
  return model;
}

CameraModel read_camera_model(TomlReader& reader, RigContent content) {
  CameraModel model = read_image_size(reader);
  const bool complete = content == RigContent::Complete;
  if (complete || reader.has("focal_px")) {
    model.focal_px = vector2(reader, "focal_px");
    if (model.focal_px.minCoeff() <= 0.0) reader.fail("focal_px", "must be two numbers above 0");
  }
  if (complete || reader.has("principal_point_px"))
    model.principal_point_px = vector2(reader, "principal_point_px");
  if (reader.has("distortion")) {
    const auto values = reader.numbers("distortion");
    const std::array<std::size_t, 5> counts{4, 5, 8, 12, kDistortionCoefficients};
    if (std::find(counts.begin(), counts.end(), values.size()) == counts.end()) {
      reader.fail("distortion",
                  fmt::format("has {} numbers; it must have 4, 5, 8, 12 or 14, in OpenCV's order: "
                              "k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y",
                              values.size()));
    }
    std::copy(values.begin(), values.end(), model.distortion.begin());
  }
  return model;
}

/// The keys that all cameras have.
Camera read_camera(TomlReader& reader, RigContent content, const Run& run) {
  Camera camera;
  camera.model = read_camera_model(reader, content);
  camera.white_level = reader.has("white_level") ? reader.integer("white_level", 1, 65535) : 255;
  if (reader.has("noise")) {
    TomlReader noise = reader.table("noise");
    const double gain = noise.positive("gain_e_per_count");
    const double read = noise.number("read_e");
    if (read < 0.0) noise.fail("read_e", fmt::format("is {}; it must be 0 or above", read));
    camera.noise = NoiseModel::from_camera(gain, read);
    noise.warn_of_unused_keys(run);
  }
  return camera;
}

/// The name of a camera, which is also that of the folders with its frames.
std::string read_camera_name(TomlReader& reader) {
  std::string name = reader.text("name");
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  if (!plain) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
    reader.fail("name",
                fmt::format("is \"{}\"; it names the folder of the camera's frames: use letters, "
                            "digits, - and _ only",
                            name));
  }
  constexpr std::string_view kTaken = "rejected";
  if (name == kTaken)
    reader.fail("name", "is \"rejected\", the folder of frames that showed motion; choose another");
  return name;
}

/// Reads the reference camera and the further cameras, whose names must differ.
std::vector<PosedCamera> read_cameras(TomlReader& reader, RigContent content, const Run& run) {
  TomlReader reference = reader.table("camera");
  std::vector<PosedCamera> cameras{{read_camera(reference, content, run)}};
  reference.warn_of_unused_keys(run);
  std::set<std::string> names;
  for (TomlReader& table : reader.tables("more_cameras")) {
    PosedCamera posed;
    posed.position_mm.setConstant(std::nan(""));
    posed.rotation.setConstant(std::nan(""));
    const std::string name = read_camera_name(table);
    posed.camera = read_camera(table, content, run);
    posed.camera.name = name;
    if (!names.insert(name).second) {
      table.fail("name",
                 fmt::format("is \"{}\", as of another camera; give each a name of its own", name));
    }
    const bool complete = content == RigContent::Complete;
    if (complete || table.has("position_mm")) posed.position_mm = vector3(table, "position_mm");
    if (complete || table.has("rotation")) posed.rotation = rotation(table, "rotation");
    if (posed.position_mm.norm() == 0.0)
      table.fail("position_mm", "is the reference camera's own centre; correct one of them");
    table.warn_of_unused_keys(run);
    cameras.push_back(std::move(posed));
  }
  return cameras;
}

FringeWaveform read_waveform(TomlReader& reader, const Run& run) {
  FringeWaveform out;
  out.period_px = reader.positive("period_px");
  out.direction = reader.named<FringeDirection>("direction");
  const std::vector<double> cosine = reader.numbers("cosine");
  const std::vector<double> sine = reader.numbers("sine", cosine.size());
  for (std::size_t i = 0; i < cosine.size(); ++i)
    out.harmonics.emplace_back(cosine[i], sine[i]);
  reader.warn_of_unused_keys(run);
  return out;
}

AngularModel read_angular_model(TomlReader& reader) {
  const auto field = reader.numbers("field_deg", 2);
  if (!(field[0] < field[1]) || field[0] <= -90.0 || field[1] >= 90.0) {
    reader.fail("field_deg", "must be two rising angles between -90 and 90");
  }
  const double scale = reader.has("pitch_scale") ? reader.positive("pitch_scale") : 1.0;
  AngularModel angular{rad_from_deg(field[0]), rad_from_deg(field[1]), scale};
  if (reader.has("wavefront_deg")) {
    const auto deviations = reader.numbers("wavefront_deg", Wavefront::kTerms);
    std::transform(deviations.begin(),
                   deviations.end(),
                   angular.wavefront.coefficients_rad.begin(),
                   rad_from_deg);
  }
  return angular;
}

/// Reads the response to grey levels and the waveforms of the fringes.
void read_response(TomlReader response, const Run& run, Projector& projector) {
  const auto light = response.numbers("light");
  const bool rises = std::is_sorted(light.begin(), light.end());
  if (light.size() < 2 || light.front() != 0.0 || light.back() != 1.0 || !rises)
    response.fail("light", "must rise from 0 to 1, one number per evenly spaced level");
  projector.response = ResponseCurve{light};
  for (TomlReader& waveform : response.tables("waveform"))
    projector.waveforms.push_back(read_waveform(waveform, run));
  response.warn_of_unused_keys(run);
}

Projector read_projector(TomlReader reader, RigContent content, const Run& run) {
  Projector projector;
  projector.position_mm.setConstant(std::nan(""));
  projector.rotation.setConstant(std::nan(""));
  const std::string model = reader.text("model");
  projector.is_label = model == "label";
  const bool complete = content == RigContent::Complete && !projector.is_label;
  if (projector.is_label) {
    // A user may switch between both uses of a calibrated projector by its model alone.
    for (const auto* calibrated :
         {"position_mm", "rotation", "focal_px", "principal_point_px", "distortion"})
      reader.ignore(calibrated);
  } else {
    if (complete || reader.has("position_mm"))
      projector.position_mm = vector3(reader, "position_mm");
    if (complete || reader.has("rotation")) projector.rotation = rotation(reader, "rotation");
  }
  if (projector.is_label) {
    projector.model = read_image_size(reader);
    if (reader.has("pixels")) projector.pixels = reader.named<PixelLayout>("pixels");
  } else if (model == "angular") {
    projector.model = read_angular_model(reader);
  } else if (model == "pinhole") {
    projector.model = read_camera_model(reader, content);
    if (reader.has("pixels")) projector.pixels = reader.named<PixelLayout>("pixels");
  } else {
    reader.fail("model",
                fmt::format(R"(is "{}"; it must be "angular", "pinhole" or "label")", model));
  }
  if (reader.has("response")) read_response(reader.table("response"), run, projector);
  if (projector.position_mm.norm() == 0.0) {
    reader.fail("position_mm", "is the camera's own centre; triangulation needs a baseline");
  }
  constexpr double kNearest_mm = 2.0;  // no lenses of camera and projector stand closer
  if (!projector.is_label && projector.position_mm.norm() < kNearest_mm) {
    reader.warn("position_mm",
                fmt::format("is {:.3g} mm from the camera, so that the lengths of this file may be "
                            "metres; they are read as millimetres",
                            projector.position_mm.norm()),
                run);
  }
  reader.warn_of_unused_keys(run);
  return projector;
}

/// Names the keys of a calibrated rig that are missing, if there are several: a rig of sizes only
/// was not mistyped, it was never calibrated.
void refuse_uncalibrated(const TomlReader& reader,
                         const toml::table& table,
                         const std::filesystem::path& path) {
  std::vector<std::string> missing;
  const auto look = [&](std::string_view name, std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
      if (!table[name].as_table()->contains(key))
        missing.push_back(fmt::format("{}.{}", name, key));
    }
  };
  if (table["camera"].is_table()) look("camera", {"focal_px", "principal_point_px"});
  const bool is_label = table["projector"]["model"].value_or(std::string_view()) == "label";
  if (table["projector"].is_table() && !is_label) {
    look("projector", {"position_mm", "rotation"});
  } else if (!reader.has("projector")) {  // of a label, the size suffices
    missing.emplace_back("[projector]");
  }
  if (missing.size() < 2) return;
  const std::string last = std::move(missing.back());
  missing.pop_back();
  throw Error(ErrorKind::Input,
              fmt::format("{}: {} and {} are missing; triangulation needs a calibrated rig, only "
                          "`frangia decode` does not",
                          path.string(),
                          fmt::join(missing, ", "),
                          last));
}

/// A projector of which nothing is known.
Projector unknown_projector() {
  Projector projector;
  projector.position_mm.setConstant(std::nan(""));
  projector.rotation.setConstant(std::nan(""));
  PinholeModel model;
  model.focal_px = model.principal_point_px = Eigen::Vector2d::Constant(std::nan(""));
  projector.model = model;
  return projector;
}

}  // namespace

Rig read_rig(const std::filesystem::path& path, const Run& run, RigContent content) {
  const toml::table table = parse_toml(path, "frangia-rig");
  TomlReader reader(path, "", table);
  for (const auto* known : {"format", "version", "devices"})
    reader.ignore(known);
  if (content == RigContent::Complete) refuse_uncalibrated(reader, table, path);
  Rig rig;
  rig.cameras = read_cameras(reader, content, run);
  const bool no_projector = content == RigContent::PhaseOnly && !reader.has("projector");
  rig.projector =
      no_projector ? unknown_projector() : read_projector(reader.table("projector"), content, run);
  if (rig.projector.is_label && rig.cameras.size() == 1 && content == RigContent::Complete) {
    reader.fail("projector.model",
                "is \"label\", which needs two cameras: add [[more_cameras]], or calibrate the "
                "projector");
  }
  if (reader.has("line")) {
    TomlReader line = reader.table("line");
    rig.laser_sheet = LaserSheet{direction(line, "normal"), line.number("offset_mm")};
    line.warn_of_unused_keys(run);
  }
  if (reader.has("turntable")) {
    TomlReader turntable = reader.table("turntable");
    rig.turntable = Turntable{vector3(turntable, "point_mm"), direction(turntable, "axis")};
    rig.turntable->point_sigma_mm =
        not_negative(turntable, "point_sigma_mm", turntable.number_or("point_sigma_mm", kMissing));
    rig.turntable->axis_sigma_rad = rad_from_deg(
        not_negative(turntable, "axis_sigma_deg", turntable.number_or("axis_sigma_deg", kMissing)));
    rig.turntable->angle_sigma_rad = rad_from_deg(not_negative(
        turntable, "angle_sigma_deg", turntable.number_or("angle_sigma_deg", kMissing)));
    turntable.warn_of_unused_keys(run);
  }
  if (reader.has("calibration"))
    rig.calibration = read_calibration(reader.table("calibration"), run);
  const bool has_covariance = rig.calibration && !rig.calibration->covariance_file.empty();
  if (has_covariance && content == RigContent::Complete) {
    rig.calibration->covariance =
        read_rig_covariance(path.parent_path() / rig.calibration->covariance_file, rig);
  }
  reader.warn_of_unused_keys(run);
  return rig;
}

}  // namespace frangia
