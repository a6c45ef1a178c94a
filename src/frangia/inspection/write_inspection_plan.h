#pragma once

#include <filesystem>
#include <string>

#include "frangia/inspection/inspection_plan.h"

namespace frangia {

/// The text of an inspection.toml in `folder` from which `parse_inspection_plan` reads the same
/// plan. What has its default is left out; files below the folder are named relative to it.
[[nodiscard]] std::string inspection_plan_text(const InspectionPlan& plan,
                                               const std::filesystem::path& folder);

/// The same as one JSON object, with the keys of inspection.toml.
[[nodiscard]] std::string inspection_plan_json(const InspectionPlan& plan,
                                               const std::filesystem::path& folder);

/// Writes inspection.toml, which appears when it is complete.
///
/// @errors   Error(File) when it cannot be written
void write_inspection_plan(const std::filesystem::path& path, const InspectionPlan& plan);

}  // namespace frangia
