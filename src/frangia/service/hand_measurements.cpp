#include "frangia/service/hand_measurements.h"

#include <cmath>
#include <exception>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/write_text_file.h"

namespace frangia {
namespace {

constexpr const char* kFile = "measurements.json";
constexpr std::size_t kMostLabel = 16;
constexpr std::size_t kMostMesh = 64;
constexpr double kLargest_mm = 1e7;

[[noreturn]] void fail(const std::string& why) {
  throw Error(ErrorKind::Input, "measurements: " + why);
}

std::string text_of(const nlohmann::json& json, const char* key, std::size_t most) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string() || found->get<std::string>().empty() ||
      found->get<std::string>().size() > most)
    fail(fmt::format("each has a {} of 1 to {} letters", key, most));
  return found->get<std::string>();
}

double number_of(const nlohmann::json& json) {
  if (!json.is_number() || !(std::abs(json.get<double>()) <= kLargest_mm))
    fail("a coordinate is a number of at most 1e7");
  return json.get<double>();
}

HandMeasurement measurement_of(const nlohmann::json& json) {
  if (!json.is_object()) fail("each is an object");
  HandMeasurement out{text_of(json, "label", kMostLabel), text_of(json, "mesh", kMostMesh), {}, {}};
  const auto points = json.find("points_mm");
  const auto sigmas = json.find("sigmas_mm");
  if (points == json.end() || !points->is_array() || points->size() < 2 || points->size() > 3)
    fail("each has two or three points_mm");
  if (sigmas == json.end() || !sigmas->is_array() || sigmas->size() != points->size())
    fail("each has as many sigmas_mm as points_mm");
  for (const nlohmann::json& point : *points) {
    if (!point.is_array() || point.size() != 3) fail("a point has three coordinates");
    out.points_mm.emplace_back(number_of(point[0]), number_of(point[1]), number_of(point[2]));
  }
  for (const nlohmann::json& sigma : *sigmas) {
    out.sigmas_mm.push_back(sigma.is_null() ? kMissing : number_of(sigma));
    if (out.sigmas_mm.back() < 0.0) fail("a sigma is 0 or more");
  }
  return out;
}

}  // namespace

std::vector<HandMeasurement> hand_measurements_of(const nlohmann::json& json) {
  if (!json.is_array() || json.size() > kMostMeasurements)
    fail(fmt::format("are a list of at most {}; remove some", kMostMeasurements));
  std::vector<HandMeasurement> all;
  std::set<std::string> labels;
  for (const nlohmann::json& one : json) {
    all.push_back(measurement_of(one));
    if (!labels.insert(all.back().label).second)
      fail(fmt::format("two have the label {}; give each its own", all.back().label));
  }
  return all;
}

nlohmann::ordered_json json_of(const std::vector<HandMeasurement>& measurements) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const HandMeasurement& one : measurements) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const Eigen::Vector3d& point : one.points_mm)
      points.push_back({point.x(), point.y(), point.z()});
    json.push_back({{"label", one.label},
                    {"mesh", one.mesh},
                    {"points_mm", points},
                    {"sigmas_mm", one.sigmas_mm}});  // NaN is written as null
  }
  return json;
}

std::vector<HandMeasurement> read_hand_measurements(const ProjectFolder& project) {
  try {
    const auto json = nlohmann::json::parse(project.read_json(kFile));
    return hand_measurements_of(json.at("measurements"));
  } catch (const std::exception&) {
    return {};
  }
}

void write_hand_measurements(const ProjectFolder& project,
                             const std::vector<HandMeasurement>& measurements) {
  const nlohmann::ordered_json json{
      {"format", "frangia-measurements"}, {"version", 1}, {"measurements", json_of(measurements)}};
  write_text_file(project.in_derived(kFile), json.dump(1) + "\n", Durability::Synced);
}

}  // namespace frangia
