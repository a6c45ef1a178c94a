#include "frangia/service/hand_measurements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <set>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

constexpr const char* kFile = "measurements.json";
constexpr std::uint64_t kMostMeasurementBytes = 1'000'000;

Json json_of_triple(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

double number_or_missing(const nlohmann::json& json) {
  return json.is_null() ? kMissing : json.get<double>();
}

Vector3d triple_of(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

/// Whether an operation of the editor leaves the mesh as it is.
bool only_selects(std::string_view operation) {
  static constexpr std::array<std::string_view, 6> kSelecting{
      "invert", "grow", "shrink", "add", "without", "within"};
  return operation.starts_with("select") ||
         std::find(kSelecting.begin(), kSelecting.end(), operation) != kSelecting.end();
}

/// Points that a program before the first release kept: two for a distance, three for an angle.
HandMeasurement measurement_of_points(const nlohmann::json& json) {
  HandMeasurement one;
  for (const auto& point : json.at("points_mm")) {
    HandElement element{.kind = "point"};
    element.point_mm = element.center_mm = triple_of(point);
    one.elements.push_back(element);
  }
  const bool angle = one.elements.size() == 3;
  const Vector3d u = one.elements.at(0).point_mm - one.elements.at(1).point_mm;
  one.value = u.norm();
  if (angle) {
    const Vector3d v = one.elements.at(2).point_mm - one.elements.at(1).point_mm;
    one.quantity = PickedQuantity::Angle;
    one.value = deg_from_rad(std::atan2(u.cross(v).norm(), u.dot(v)));
  }
  one.from_mm = one.elements.front().point_mm;
  one.to_mm = one.elements.back().point_mm;
  return one;
}

HandMeasurement measurement_of(const nlohmann::json& json) {
  HandMeasurement one;
  if (json.contains("points_mm")) {
    one = measurement_of_points(json);
  } else {
    one.quantity = value_named<PickedQuantity>("quantity", json.at("quantity").get<std::string>());
    one.value = number_or_missing(json.at("value"));
    one.u95 = number_or_missing(json.at("u95"));
    one.from_mm = triple_of(json.at("from_mm"));
    one.to_mm = triple_of(json.at("to_mm"));
    for (const auto& element : json.at("elements")) {
      one.elements.push_back({element.at("kind").get<std::string>(),
                              triple_of(element.at("point_mm")),
                              triple_of(element.at("center_mm")),
                              triple_of(element.at("axis")),
                              number_or_missing(element.at("diameter_mm")),
                              number_or_missing(element.at("form_mm"))});
    }
  }
  one.label = json.at("label").get<std::string>();
  one.mesh = json.at("mesh").get<std::string>();
  return one;
}

HandElement element_of(const PickedElement& picked) {
  const Shape& shape = picked.feature.fit.shape;
  HandElement element{.kind = picked.face ? std::string(name_of(shape.kind)) : "point"};
  element.point_mm = picked.point_mm;
  element.center_mm = shape.center_mm;
  element.axis = shape.axis;
  if (!picked.face) return element;
  if (shape.kind != ShapeKind::Plane) element.diameter_mm = 2.0 * shape.radius_mm;
  element.form_mm = picked.feature.fit.form_mm;
  return element;
}

}  // namespace

std::string mesh_name(int version, std::span<const EditStep> done) {
  Json edits = Json::array();
  for (const EditStep& step : done)
    if (!only_selects(step.operation)) edits.push_back({step.operation, step.value});
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char letter :
       edits.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace))
    hash = (hash ^ static_cast<std::uint8_t>(letter)) * 16777619U;
  return fmt::format("{}-{:x}", version, hash);
}

std::string free_label(const std::vector<HandMeasurement>& measurements) {
  constexpr std::size_t kLetters = 26;
  std::set<std::string> taken;
  for (const HandMeasurement& one : measurements)
    taken.insert(one.label);
  for (std::size_t i = 0;; ++i) {
    std::string label(1, static_cast<char>('A' + i % kLetters));
    if (i >= kLetters) label += std::to_string(i / kLetters + 1);
    if (!taken.contains(label)) return label;
  }
}

HandMeasurement hand_measurement_of(const PickedMeasurement& found,
                                    std::string label,
                                    std::string mesh) {
  HandMeasurement one{.label = std::move(label),
                      .mesh = std::move(mesh),
                      .quantity = found.quantity,
                      .value = found.value,
                      .u95 = found.u95,
                      .elements = {},
                      .from_mm = found.from_mm,
                      .to_mm = found.to_mm};
  for (const PickedElement& element : found.elements)
    one.elements.push_back(element_of(element));
  if (one.elements.empty()) {
    HandElement all{.kind = found.of_selection ? "selection" : "surface"};
    all.point_mm = all.center_mm = found.from_mm;
    one.elements.push_back(all);
  }
  return one;
}

nlohmann::ordered_json json_of(const std::vector<HandMeasurement>& measurements) {
  Json json = Json::array();
  for (const HandMeasurement& one : measurements) {
    Json elements = Json::array();
    for (const HandElement& element : one.elements) {
      elements.push_back({{"kind", element.kind},
                          {"point_mm", json_of_triple(element.point_mm)},
                          {"center_mm", json_of_triple(element.center_mm)},
                          {"axis", json_of_triple(element.axis)},
                          {"diameter_mm", element.diameter_mm},
                          {"form_mm", element.form_mm}});
    }
    json.push_back({{"label", one.label},
                    {"mesh", one.mesh},
                    {"quantity", name_of(one.quantity)},
                    {"value", one.value},
                    {"unit", unit_of(one.quantity)},
                    {"u95", one.u95},  // NaN is written as null
                    {"elements", std::move(elements)},
                    {"from_mm", json_of_triple(one.from_mm)},
                    {"to_mm", json_of_triple(one.to_mm)}});
  }
  return json;
}

std::vector<HandMeasurement> read_hand_measurements(const ProjectFolder& project) {
  try {
    const auto json = nlohmann::json::parse(project.read_json(kFile, kMostMeasurementBytes));
    std::vector<HandMeasurement> all;
    for (const auto& one : json.at("measurements")) {
      if (all.size() == kMostMeasurements) break;
      all.push_back(measurement_of(one));
    }
    return all;
  } catch (const std::exception&) {
    return {};
  }
}

void write_hand_measurements(const ProjectFolder& project,
                             const std::vector<HandMeasurement>& measurements) {
  const Json json{
      {"format", "frangia-measurements"}, {"version", 2}, {"measurements", json_of(measurements)}};
  write_text_file(project.in_derived(kFile), json.dump() + "\n", Durability::Synced);
}

}  // namespace frangia
