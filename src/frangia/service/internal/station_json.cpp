#include "frangia/service/internal/station_json.h"

#include <string>

namespace frangia {

nlohmann::ordered_json json_of(const ProjectStation& station) {
  return {{"angle_deg", station.angle_deg},
          {"setup", station.setup},
          {"state", name_of(station.state)},
          {"verdict", station.verdict},
          {"good", station.good},
          {"contrast", station.contrast},
          {"saturated", station.saturated},
          {"points", station.points},
          {"has_cloud", station.has_cloud}};
}

ProjectStation station_from(const nlohmann::json& json) {
  ProjectStation station;
  station.angle_deg = json.at("angle_deg").get<double>();
  station.setup = json.value("setup", 0);  // not in files of earlier versions
  const auto state = json.at("state").get<std::string>();
  if (state == "done") station.state = StationState::Done;
  if (state == "skipped") station.state = StationState::Skipped;
  station.verdict = json.at("verdict").get<std::string>();
  station.good = json.at("good").get<bool>();
  station.contrast = json.at("contrast").get<double>();
  station.saturated = json.at("saturated").get<double>();
  station.points = json.at("points").get<std::size_t>();
  station.has_cloud = json.at("has_cloud").get<bool>();
  return station;
}

}  // namespace frangia
