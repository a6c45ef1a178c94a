#include "frangia/rig/write_rig.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <sstream>
#include <string>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/rig/internal/calibration_table.h"
#include "frangia/rig/rig_covariance.h"
#include "frangia/rig/toml_reader.h"
#include "frangia/rig/toml_writer.h"

namespace frangia {
namespace {

std::vector<double> list_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// The distortion without the groups of coefficients at the end that are 0.
std::vector<double> shortest_distortion(const CameraModel& model) {
  const auto last = std::find_if(
      model.distortion.rbegin(), model.distortion.rend(), [](double c) { return c != 0.0; });
  const auto used = static_cast<std::size_t>(model.distortion.rend() - last);
  const std::size_t count = used <= 5 ? 5 : used <= 8 ? 8 : used <= 12 ? 12 : 14;
  return {model.distortion.begin(), model.distortion.begin() + static_cast<std::ptrdiff_t>(count)};
}

void put_camera_model(TomlWriter& writer, const CameraModel& model) {
  writer.put("size_px", std::vector<int>{model.width_px, model.height_px});
  if (model.focal_px.allFinite())
    writer.put("focal_px", std::vector{model.focal_px.x(), model.focal_px.y()});
  if (model.principal_point_px.allFinite()) {
    writer.put("principal_point_px",
               std::vector{model.principal_point_px.x(), model.principal_point_px.y()});
  }
  writer.put("distortion", shortest_distortion(model));
}

/// Pose of a device in the rig frame; NaN where it is not known.
void put_pose(TomlWriter& writer, const Eigen::Vector3d& position_mm, const Eigen::Matrix3d& r) {
  if (position_mm.allFinite()) writer.put("position_mm", list_of(position_mm));
  if (!r.allFinite()) return;
  writer.put("rotation",
             std::vector{list_of(r.row(0).transpose()),
                         list_of(r.row(1).transpose()),
                         list_of(r.row(2).transpose())});
}

/// `table` is the name of the camera's table, which the caller has begun.
void put_camera(TomlWriter& writer, const Camera& camera, const std::string& table) {
  put_camera_model(writer, camera.model);
  writer.put("white_level", camera.white_level);
  if (!camera.noise) return;
  const double gain = 1.0 / camera.noise->slope_counts;
  const double read2 = std::max(0.0, camera.noise->floor_counts2 - 1.0 / 12.0);
  writer.begin_table(table + ".noise");
  writer.put("gain_e_per_count", gain);
  writer.put("read_e", gain * std::sqrt(read2));
}

void put_response(TomlWriter& writer, const Projector& projector) {
  if (!projector.response) return;
  constexpr int kDigits = 6;  // a measured response is less certain than the sixth digit
  const auto rounded = [&](const std::vector<double>& values) {
    std::vector<double> out;
    out.reserve(values.size());
    for (const double value : values)
      out.push_back(rounded_to_digits(value, kDigits));
    return out;
  };
  writer.begin_table("projector.response");
  writer.put("light", rounded(projector.response->light));
  for (const FringeWaveform& waveform : projector.waveforms) {
    std::vector<double> cosine;
    std::vector<double> sine;
    for (const std::complex<double>& harmonic : waveform.harmonics) {
      cosine.push_back(harmonic.real());
      sine.push_back(harmonic.imag());
    }
    writer.begin_table_of_list("projector.response.waveform");
    writer.put("period_px", waveform.period_px);
    writer.put("direction", std::string(name_of(waveform.direction)));
    writer.put("cosine", rounded(cosine));
    writer.put("sine", rounded(sine));
  }
}

void put_projector(TomlWriter& writer, const Projector& projector) {
  writer.begin_table("projector");
  writer.put("model",
             std::string(projector.is_label       ? "label"
                         : projector.is_angular() ? "angular"
                                                  : "pinhole"));
  if (!projector.is_label) put_pose(writer, projector.position_mm, projector.rotation);
  if (const auto* angular = std::get_if<AngularModel>(&projector.model)) {
    writer.put(
        "field_deg",
        std::vector{deg_from_rad(angular->field_min_rad), deg_from_rad(angular->field_max_rad)});
    if (angular->pitch_scale != 1.0) writer.put("pitch_scale", angular->pitch_scale);
    if (!angular->wavefront.is_plane()) {
      std::vector<double> deviations;
      for (const double coefficient : angular->wavefront.coefficients_rad)
        deviations.push_back(deg_from_rad(coefficient));
      writer.put("wavefront_deg", deviations);
    }
  } else {
    const auto& pinhole = std::get<PinholeModel>(projector.model);
    if (projector.is_label) {
      writer.put("size_px", std::vector<int>{pinhole.width_px, pinhole.height_px});
    } else {
      put_camera_model(writer, pinhole);
    }
    if (projector.pixels != PixelLayout::Square)
      writer.put("pixels", std::string(name_of(projector.pixels)));
  }
  put_response(writer, projector);
}

void put_turntable(TomlWriter& writer, const Turntable& table) {
  writer.begin_table("turntable");
  writer.put("point_mm", list_of(table.point_mm));
  writer.put("axis", list_of(table.axis));
  const auto put_sigma = [&](const char* key, double sigma) {
    if (!std::isnan(sigma)) writer.put(key, sigma);
  };
  put_sigma("point_sigma_mm", table.point_sigma_mm);
  put_sigma("axis_sigma_deg", deg_from_rad(table.axis_sigma_rad));
  put_sigma("angle_sigma_deg", deg_from_rad(table.angle_sigma_rad));
}

TomlWriter composed_rig(const Rig& rig) {
  TomlWriter writer;
  writer.put("format", std::string("frangia-rig"));
  writer.put("version", 1);
  writer.begin_table("camera");
  put_camera(writer, rig.reference(), "camera");
  for (std::size_t i = 1; i < rig.cameras.size(); ++i) {
    const PosedCamera& posed = rig.cameras[i];
    writer.begin_table_of_list("more_cameras");
    writer.put("name", posed.camera.name);
    put_pose(writer, posed.position_mm, posed.rotation);
    put_camera(writer, posed.camera, "more_cameras");
  }
  put_projector(writer, rig.projector);
  if (rig.laser_sheet) {
    writer.begin_table("line");
    writer.put("normal", list_of(rig.laser_sheet->normal));
    writer.put("offset_mm", rig.laser_sheet->offset_mm);
  }
  if (rig.turntable) put_turntable(writer, *rig.turntable);
  if (rig.calibration) put_calibration(writer, *rig.calibration);
  return writer;
}

/// The tables of [devices] in a rig.toml, as text.
std::string devices_of(const std::filesystem::path& path) {
  const toml::table table = parse_toml(path, "frangia-rig");
  const toml::table* devices = table["devices"].as_table();
  if (devices == nullptr) return "";
  std::ostringstream text;
  text << "\n" << toml::table{{"devices", *devices}} << "\n";
  return text.str();
}

/// The lines of a rig.toml but for one table and the tables within it.
std::string without_table(const std::string& rig_toml, const std::string& table) {
  std::string text;
  std::istringstream lines(rig_toml);
  bool left_out = false;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin != std::string::npos && line[begin] == '[') {
      std::string name = line.substr(begin, line.find(']', begin) - begin);
      name.erase(0, name.find_first_not_of("[ \t"));
      name.erase(name.find_last_not_of(" \t") + 1);
      left_out = name == table || name.starts_with(table + ".");
    }
    if (!left_out) text += line + '\n';
  }
  while (text.ends_with("\n\n"))
    text.pop_back();
  return text;
}

}  // namespace

std::string rig_text(const Rig& rig) {
  return composed_rig(rig).text();
}

std::string with_response(const std::string& rig_toml, const Projector& projector) {
  TomlWriter writer;
  put_response(writer, projector);
  return without_table(rig_toml, "projector.response") + writer.text();
}

std::string with_turntable(const std::string& rig_toml, const Turntable& table) {
  TomlWriter writer;
  put_turntable(writer, table);
  return without_table(rig_toml, "turntable") + writer.text();
}

void write_rig(const std::filesystem::path& path,
               const Rig& rig,
               Durability durability,
               const std::filesystem::path& devices_from) {
  const std::string devices = devices_from.empty() ? "" : devices_of(devices_from);
  Rig named = rig;
  if (rig.calibration && !rig.calibration->covariance.empty()) {
    std::string& name = named.calibration->covariance_file;
    if (name.empty()) name = path.stem().string() + "-covariance.csv";
    write_rig_covariance(path.parent_path() / name, rig.calibration->covariance);
  }
  write_text_file(path, rig_text(named) + devices, durability);
}

}  // namespace frangia
