#include "frangia/service/capture_settings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/phase/algorithm/published_algorithms.h"
#include "frangia/simulate/default_patterns.h"

namespace frangia {

void CaptureSettings::check() const {
  require(camera.exposure_ms > 0.0, "`exposure_ms` must be above 0");
  require(exposures_ms.size() <= kMostExposures,
          fmt::format("`exposures_ms` must be {} numbers at most", kMostExposures).c_str());
  require(std::all_of(exposures_ms.begin(),
                      exposures_ms.end(),
                      [](double one) { return std::isfinite(one) && one > 0.0; }),
          "`exposures_ms` must be numbers above 0");
  require(camera.gain_db >= 0.0, "gain_db must be 0 or more");
  require(camera.black_level_counts >= 0.0, "black_level_counts must be 0 or more");
  require(shifts >= kFewestShifts && shifts <= kMostShifts,
          fmt::format("`shifts` must be from {} to {}", kFewestShifts, kMostShifts).c_str());
  const auto& known = published_algorithms();
  const bool named = std::any_of(known.begin(), known.end(), [&](const PublishedAlgorithm& one) {
    return one.name == algorithm;
  });
  require(named || algorithm == "auto",
          "`algorithm` must be auto or a name that `frangia algorithms` lists");
}

bool CaptureSettings::operator==(const CaptureSettings& other) const {
  return camera.exposure_ms == other.camera.exposure_ms && camera.gain_db == other.camera.gain_db &&
         camera.black_level_counts == other.camera.black_level_counts &&
         exposures_ms == other.exposures_ms && shifts == other.shifts &&
         algorithm == other.algorithm;
}

CaptureSettings read_capture_settings(const std::filesystem::path& file) {
  CaptureSettings settings;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return settings;
  try {
    const auto json = nlohmann::json::parse(read_json_below(file.parent_path(), file.filename()));
    settings.camera.exposure_ms = json.at("exposure_ms").get<double>();
    settings.camera.gain_db = json.at("gain_db").get<double>();
    settings.camera.black_level_counts = json.at("black_level_counts").get<double>();
    settings.exposures_ms = json.value("exposures_ms", std::vector<double>());
    settings.shifts = json.at("shifts").get<int>();
    settings.algorithm = json.at("algorithm").get<std::string>();
    settings.check();
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: is damaged; delete it to begin with the defaults", file.string()));
  } catch (const Error& error) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", file.string(), error.what()));
  }
  return settings;
}

void write_capture_settings(const std::filesystem::path& file, const CaptureSettings& settings) {
  const nlohmann::ordered_json json{{"exposure_ms", settings.camera.exposure_ms},
                                    {"gain_db", settings.camera.gain_db},
                                    {"black_level_counts", settings.camera.black_level_counts},
                                    {"exposures_ms", settings.exposures_ms},
                                    {"shifts", settings.shifts},
                                    {"algorithm", settings.algorithm}};
  write_text_file(file, json.dump(1) + "\n");
}

std::vector<Pattern> patterns_of(const CaptureSettings& settings, const Rig& rig) {
  PatternPlan plan;
  plan.shifts = settings.shifts;
  plan.exposures_ms = settings.exposures_ms;
  return default_patterns(rig, plan);
}

}  // namespace frangia
