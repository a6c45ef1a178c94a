#include "frangia/service/internal/rig_json.h"

#include <array>
#include <cmath>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

using RigJson = nlohmann::ordered_json;

RigJson list_of(const Eigen::Isometry3d& pose) {
  RigJson list = RigJson::array();
  for (Eigen::Index row = 0; row < 4; ++row) {
    for (Eigen::Index column = 0; column < 4; ++column)
      list.push_back(pose.matrix()(row, column));
  }
  return list;
}

RigJson list_of(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

RigJson json_of_optics(const CameraModel& model) {
  return {{"width_px", model.width_px},
          {"height_px", model.height_px},
          {"focal_px", {model.focal_px.x(), model.focal_px.y()}},
          {"principal_point_px", {model.principal_point_px.x(), model.principal_point_px.y()}}};
}

/// An advice for a page to word in its language, and in English.
RigJson json_of(const PoseAdvice& advice) {
  static constexpr std::array kKinds = {
      "repeat", "sufficient", "move", "tilt", "nearer", "farther"};
  return {{"kind", kKinds.at(static_cast<std::size_t>(advice.kind))},
          {"side", advice.side},
          {"place", advice.place},
          {"text", advice.text()}};
}

}  // namespace

RigJson json_of_rig(const Rig& rig) {
  Eigen::Isometry3d rig_from_projector = Eigen::Isometry3d::Identity();
  rig_from_projector.linear() = rig.projector.rotation.transpose();
  rig_from_projector.translation() = rig.projector.position_mm;
  RigJson json{{"camera", json_of_optics(rig.reference().model)},
               {"rig_from_projector", list_of(rig_from_projector)},
               {"baseline_mm", rig.projector.position_mm.norm()}};
  if (const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model)) {
    json["projector"] = json_of_optics(*pinhole);
    json["field_deg"] = nullptr;
  } else {
    const auto& angular = std::get<AngularModel>(rig.projector.model);
    json["projector"] = nullptr;
    json["field_deg"] = {deg_from_rad(angular.field_min_rad), deg_from_rad(angular.field_max_rad)};
  }
  json["laser_sheet"] = nullptr;
  if (rig.laser_sheet) {
    json["laser_sheet"] = {{"normal", list_of(rig.laser_sheet->normal)},
                           {"offset_mm", rig.laser_sheet->offset_mm}};
  }
  json["turntable"] = nullptr;
  if (rig.turntable) {
    json["turntable"] = {{"object_from_rig", list_of(rig.rig_from_object(0.0).inverse())},
                         {"distance_mm", rig.turntable->point_mm.norm()}};
  }
  json["calibration"] = nullptr;
  if (rig.calibration) {
    json["calibration"] = {{"date", rig.calibration->date},
                           {"poses", rig.calibration->poses},
                           {"point_sigma_mm", rig.calibration->point_sigma_mm},
                           {"distance_mm", rig.calibration->distance_mm}};
  }
  return json;
}

RigJson json_of_devices(const std::vector<ProjectDevice>& devices) {
  RigJson all = RigJson::array();
  for (const ProjectDevice& device : devices) {
    all.push_back({{"table", device.test.table},
                   {"driver", device.test.driver},
                   {"settings", device.settings},
                   {"name", device.test.name},
                   {"answer", device.test.answer},
                   {"fault", device.test.fault}});
  }
  return all;
}

RigJson json_of_search(const DeviceSearch& search) {
  RigJson json{{"connected", RigJson::array()}, {"drivers", RigJson::array()}};
  for (const ConnectedDevice& device : search.connected) {
    RigJson one{{"table", table_name(device.kind)},
                {"driver", device.driver},
                {"name", device.found.name},
                {"settings", device.found.settings},
                {"modes", RigJson::array()}};
    for (const DeviceMode& mode : device.found.modes)
      one["modes"].push_back({{"name", mode.name}, {"settings", mode.settings}});
    json["connected"].push_back(one);
  }
  for (const Driver& driver : search.drivers) {
    RigJson one{{"table", table_name(driver.kind)},
                {"driver", driver.name},
                {"description", driver.description},
                {"identifies", driver.identify != nullptr},
                {"choices", RigJson::object()}};
    for (const SettingChoices& setting : driver.choices)
      one["choices"][setting.key] = setting.values;
    json["drivers"].push_back(one);
  }
  json["warnings"] = search.warnings;
  return json;
}

RigJson json_of_axis(const FoundAxis& axis) {
  return {{"views", axis.views},
          {"axis_sigma_deg", axis.axis_sigma_deg},
          {"point_sigma_mm", axis.point_sigma_mm},
          {"angles_rms_deg", axis.angles_rms_deg},
          {"distance_mm", axis.distance_mm},
          {"of_scan", axis.of_scan}};
}

RigJson json_of_figures(const RigFigures& figures) {
  RigJson sigma;  // null
  if (std::isfinite(figures.point_sigma_mm)) sigma = figures.point_sigma_mm;
  return {{"date", figures.date},
          {"poses", figures.poses},
          {"point_sigma_mm", sigma},
          {"has_turntable", figures.has_turntable},
          {"has_axis", figures.has_axis},
          {"drivers", figures.drivers}};
}

RigJson json_of_kept(const std::vector<KeptRig>& kept) {
  RigJson all = RigJson::array();
  for (const KeptRig& rig : kept) {
    RigJson one{{"number", rig.number}, {"kept_s", rig.kept_s}, {"before", rig.before}};
    one.update(json_of_figures(rig.figures));
    all.push_back(one);
  }
  return all;
}

RigJson json_of_check(const ScanCheck& check) {
  return {{"at_s", check.at_s},
          {"contrast", check.contrast},
          {"saturated", check.saturated},
          {"points", check.points},
          {"finding", check.finding}};
}

RigJson json_of_display(const DisplayMeasurement& display) {
  return {{"exposure_ms", display.exposure_ms},
          {"latency_s", display.latency_s},
          {"delay_s", display.delay_s},
          {"late_frames", display.late_frames},
          {"camera_fps", display.camera_fps},
          {"patterns_per_s", display.patterns_per_s},
          {"mains_hz", display.mains_hz},
          {"room_flicker", display.room_flicker},
          {"exposure_step_ms", display.exposure_step_ms},
          {"half_light", display.response ? RigJson(display.response->light_of(0.5)) : RigJson()},
          {"sharpness", display.sharpness},
          {"white_level", display.white_level},
          {"dark_zeros", display.dark_zeros},
          {"findings", display.findings}};
}

RigJson json_of_wizard(const WizardState& state) {
  const PoseCoverage& coverage = state.coverage;
  RigJson json{
      {"active", state.active},
      {"waiting", state.waiting},
      {"naming", state.naming},
      {"found", state.found},
      {"wanted", state.wanted},
      {"with_board", coverage.poses},
      {"field", state.field},
      {"cells", coverage.cells},
      {"columns", PoseCoverage::kColumns},
      {"distance_ratio", coverage.nearest > 0.0 ? coverage.farthest / coverage.nearest : 1.0},
      {"tilts_deg", coverage.tilts_deg},
      {"sufficient", state.sufficient},
      {"next", json_of(coverage.next)},
      {"findings", state.findings},
      {"fault", state.fault}};
  const Board& board = state.board;  // of no columns until a printed one has said which it is
  json["board"] = board.columns == 0 ? RigJson()
                                     : RigJson{{"columns", board.columns},
                                               {"rows", board.rows},
                                               {"square_mm", board.square_mm}};
  json["poses"] = RigJson::array();
  for (const WizardPose& pose : state.poses)
    json["poses"].push_back({{"points", pose.points}, {"expected", pose.expected}});
  const WizardVerdict& verdict = state.verdict;
  json["verdict"] = nullptr;
  if (!verdict.grade.empty()) {
    json["verdict"] = {{"grade", verdict.grade},
                       {"point_sigma_mm", verdict.point_sigma_mm},
                       {"spread_mm", verdict.spread_mm},
                       {"distance_mm", verdict.distance_mm},
                       {"baseline_mm", verdict.baseline_mm},
                       {"camera_rms_px", verdict.camera_rms_px},
                       {"projector_rms_px", verdict.projector_rms_px},
                       {"poses", verdict.poses}};
  }
  return json;
}

namespace {

/// A value of JSON as TOML writes it.
std::string toml_of(const nlohmann::json& value) {
  if (value.is_object()) {
    std::string inner;
    for (const auto& [key, one] : value.items()) {
      if (one.is_null()) continue;
      inner += (inner.empty() ? "" : ", ") + nlohmann::json(key).dump() + " = " + toml_of(one);
    }
    return "{" + inner + "}";
  }
  if (value.is_array()) {
    std::string inner;
    for (const nlohmann::json& one : value)
      inner += (inner.empty() ? "" : ", ") + toml_of(one);
    return "[" + inner + "]";
  }
  return value.dump();
}

}  // namespace

std::string toml_text(const nlohmann::json& object, std::string_view format) {
  std::string text = fmt::format("format = \"{}\"\nversion = 1\n", format);
  for (const auto& [key, value] : object.items()) {
    if (key == "format" || key == "version" || value.is_null()) continue;
    text += nlohmann::json(key).dump() + " = " + toml_of(value) + "\n";
  }
  return text;
}

}  // namespace frangia
