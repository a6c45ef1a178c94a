#pragma once

#include <memory>

#include "frangia/service/internal/surface_model.h"

namespace frangia {

/// Inspects a mesh against the file that its plan names; nothing is measured against where the plan
/// names none.
///
/// @errors   as read_inspection_reference and inspect_part
[[nodiscard]] std::shared_ptr<const ShownInspection> shown_inspection(
    const Mesh& mesh, const InspectionRequest& asked, int count, const Run& run);

/// The deviations from the reference for the state; null without one.
[[nodiscard]] nlohmann::ordered_json json_of_comparison(const ShownInspection& shown);

/// The verdict, characteristics, features and places for the state. Places are in the frame of the
/// surface as it is drawn, those of features also in that of the reference.
[[nodiscard]] nlohmann::ordered_json json_of_inspection(const ShownInspection& shown);

}  // namespace frangia
