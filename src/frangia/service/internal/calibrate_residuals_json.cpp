#include "frangia/service/internal/calibrate_residuals_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "frangia/calibrate/report/residual_maps.h"
#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// Rounded to what a picture can show, so that the text stays short.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}

}  // namespace

std::string residuals_text(const RigCalibration& result) {
  constexpr std::size_t kMostArrows = 4000;
  constexpr double kPlace_px = 0.1;
  constexpr double kResidual_px = 1e-3;
  nlohmann::ordered_json json;
  json["poses"] = nlohmann::ordered_json::array();
  for (const PoseResiduals& pose : pose_residuals(result)) {
    json["poses"].push_back({{"name", pose.name},
                             {"camera_rms_px", pose.camera_rms_px},
                             {"projector_rms_px", pose.projector_rms_px},
                             {"distance_mm", pose.distance_mm},
                             {"tilt_deg", deg_from_rad(pose.tilt_rad)},
                             {"change_mm", pose.change_mm},
                             {"outlier", pose.is_outlier}});
  }
  json["maps"] = nlohmann::ordered_json::array();
  for (const ResidualMap& map : residual_maps(result)) {
    nlohmann::ordered_json entry{{"title", map.title},
                                 {"width", map.width},
                                 {"height", map.height},
                                 {"rms_px", map.rms},
                                 {"points", map.arrows.size()}};
    entry["arrows"] = nlohmann::ordered_json::array();
    const std::size_t step = map.arrows.size() / (kMostArrows + 1) + 1;
    for (std::size_t i = 0; i < map.arrows.size(); i += step) {
      const auto& [from, residual] = map.arrows[i];
      entry["arrows"].push_back({rounded(from.x(), kPlace_px),
                                 rounded(from.y(), kPlace_px),
                                 rounded(residual.x(), kResidual_px),
                                 rounded(residual.y(), kResidual_px)});
    }
    json["maps"].push_back(entry);
  }
  return json.dump();
}

}  // namespace frangia
