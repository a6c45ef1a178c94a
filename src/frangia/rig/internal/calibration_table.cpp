#include "frangia/rig/internal/calibration_table.h"

#include <fmt/format.h>

namespace frangia {

Calibration read_calibration(TomlReader reader, const Run& run) {
  constexpr int kMostPoses = 1'000'000;
  Calibration calibration;
  if (reader.has("date")) calibration.date = reader.text("date");
  if (reader.has("board")) calibration.board = reader.text("board");
  if (reader.has("poses")) calibration.poses = reader.integer("poses", 0, kMostPoses);
  calibration.camera_rms_px = reader.number_or("camera_rms_px", 0.0);
  calibration.projector_rms_px = reader.number_or("projector_rms_px", 0.0);
  calibration.point_sigma_mm = reader.number_or("point_sigma_mm", 0.0);
  calibration.distance_mm = reader.number_or("distance_mm", 0.0);
  if (reader.has("covariance")) calibration.covariance_file = reader.text("covariance");
  if (reader.has("sigma")) {
    TomlReader sigma = reader.table("sigma");
    for (const std::string& name : sigma.keys())
      calibration.sigma.emplace_back(name, sigma.number(name));
  }
  reader.warn_of_unused_keys(run);
  return calibration;
}

std::string toml_of(const Calibration& calibration) {
  std::string text = "\n[calibration]\n";
  text += fmt::format("date = \"{}\"\nboard = \"{}\"\nposes = {}\n",
                      calibration.date,
                      calibration.board,
                      calibration.poses);
  text += fmt::format("camera_rms_px = {:.4g}\nprojector_rms_px = {:.4g}\n",
                      calibration.camera_rms_px,
                      calibration.projector_rms_px);
  text += fmt::format("point_sigma_mm = {:.3g}\ndistance_mm = {:.4g}\n",
                      calibration.point_sigma_mm,
                      calibration.distance_mm);
  if (!calibration.covariance_file.empty())
    text += fmt::format("covariance = \"{}\"\n", calibration.covariance_file);
  if (calibration.sigma.empty()) return text;
  text += "\n[calibration.sigma]\n";
  for (const auto& [name, sigma] : calibration.sigma)
    text += fmt::format("\"{}\" = {:.4g}\n", name, sigma);
  return text;
}

}  // namespace frangia
