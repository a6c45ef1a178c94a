#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/features/find_features.h"

namespace frangia {

/// Adds `features`, one entry for each feature, and `feature_details`, what else is known of it.
void add_features(nlohmann::ordered_json& json, const std::vector<Feature>& features);

/// A table of features, for people.
[[nodiscard]] std::string feature_table(const std::vector<Feature>& features);

}  // namespace frangia
