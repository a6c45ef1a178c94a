#pragma once

#include <memory>
#include <string>

#include "frangia/service/internal/surface_model.h"

namespace frangia {

/// Inspects a mesh by a plan, against the file that the plan names; its name for people is
/// `reference`. Nothing is measured against where the plan names none.
///
/// @errors   as read_inspection_reference and inspect_part
[[nodiscard]] std::shared_ptr<const ShownInspection> shown_inspection(const Mesh& mesh,
                                                                      const InspectionPlan& plan,
                                                                      const std::string& reference,
                                                                      int count,
                                                                      const Run& run);

/// The inspection for the state.
[[nodiscard]] nlohmann::ordered_json json_of_inspection(const ShownInspection& shown);

}  // namespace frangia
