#pragma once

#include <nlohmann/json.hpp>

#include "frangia/service/project_scan.h"

namespace frangia {

/// A station as stations.json and the state of the service hold it.
[[nodiscard]] nlohmann::ordered_json json_of(const ProjectStation& station);

/// The station that `json_of` wrote; one that was being captured waits again.
///
/// @errors   nlohmann::json::exception for missing keys and other types
[[nodiscard]] ProjectStation station_from(const nlohmann::json& json);

}  // namespace frangia
