#pragma once

#include <optional>

#include "inspect_reference.h"
#include "inspect_report.h"

namespace frangia {

/// Inspects `arguments.mesh`: aligns it, finds and measures its features, compares it with the
/// reference, and adds to the answer what it finds.
[[nodiscard]] InspectedPart inspect_mesh(const InspectArguments& arguments,
                                         const InspectionPlan& plan,
                                         const std::optional<Reference>& reference,
                                         InspectAnswer& answer,
                                         const Run& run);

}  // namespace frangia
