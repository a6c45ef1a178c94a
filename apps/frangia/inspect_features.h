#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/cad/nominal_face.h"
#include "frangia/features/find_features.h"

namespace frangia {

/// Adds `features`, one entry for each feature, and `feature_details`, what else is known of it.
/// `nominals` holds the CAD face of each; empty without a CAD reference.
void add_features(nlohmann::ordered_json& json,
                  const std::vector<Feature>& features,
                  const std::vector<std::optional<NominalFace>>& nominals);

/// A table of features, for people.
[[nodiscard]] std::string feature_table(const std::vector<Feature>& features,
                                        const std::vector<std::optional<NominalFace>>& nominals);

}  // namespace frangia
