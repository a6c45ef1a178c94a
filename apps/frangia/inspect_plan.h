#pragma once

#include <CLI/CLI.hpp>

#include "frangia/inspection/inspection_plan.h"

#include "inspect_arguments.h"

namespace frangia {

/// The plan by which the part is inspected: the one that the arguments name or a CAD file asks for,
/// and what the command line states instead of it or adds to it.
///
/// @errors   Error(Input) as read_inspection_plan, read_cad and plan_from_pmi, and for a tolerance
///           whose limits are exchanged
[[nodiscard]] InspectionPlan plan_of(const InspectArguments& arguments, const Run& run);

/// A section such as "z=60", for CLI::Option::check.
[[nodiscard]] CLI::Validator a_section();

}  // namespace frangia
