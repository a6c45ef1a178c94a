#include "frangia/rig/internal/calibration_table.h"

#include <filesystem>

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
  if (reader.has("covariance")) {
    calibration.covariance_file = reader.text("covariance");
    if (std::filesystem::path(calibration.covariance_file).filename() !=
        calibration.covariance_file)
      reader.fail("covariance", "must be the name of a file in the same folder");
  }
  if (reader.has("sigma")) {
    TomlReader sigma = reader.table("sigma");
    for (const std::string& name : sigma.keys())
      calibration.sigma.emplace_back(name, sigma.number(name));
  }
  reader.warn_of_unused_keys(run);
  return calibration;
}

void put_calibration(TomlWriter& writer, const Calibration& calibration) {
  constexpr int kDigits = 4;  // the estimates are less certain than the fourth digit
  const auto rounded = [](double value) { return rounded_to_digits(value, kDigits); };
  writer.begin_table("calibration");
  writer.put("date", calibration.date);
  writer.put("board", calibration.board);
  writer.put("poses", calibration.poses);
  writer.put("camera_rms_px", rounded(calibration.camera_rms_px));
  writer.put("projector_rms_px", rounded(calibration.projector_rms_px));
  writer.put("point_sigma_mm", rounded(calibration.point_sigma_mm));
  writer.put("distance_mm", rounded(calibration.distance_mm));
  if (!calibration.covariance_file.empty()) writer.put("covariance", calibration.covariance_file);
  if (calibration.sigma.empty()) return;
  writer.begin_table("calibration.sigma");
  for (const auto& [name, sigma] : calibration.sigma)
    writer.put(fmt::format("\"{}\"", name), rounded(sigma));
}

}  // namespace frangia
