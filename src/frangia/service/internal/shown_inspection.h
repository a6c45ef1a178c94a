#pragma once

#include <memory>
#include <string>

#include "frangia/service/internal/surface_model.h"

namespace frangia {

/// A plan that nobody made: the best fit, with the usual tolerance.
[[nodiscard]] InspectionPlan usual_plan();

/// What the results of an inspection depend on: the plan without the head of the report, and which
/// file is its reference. Two inspections of one surface with the same text have the same results.
[[nodiscard]] std::string inspection_basis(InspectionPlan plan,
                                           const std::string& reference,
                                           int reference_number);

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
