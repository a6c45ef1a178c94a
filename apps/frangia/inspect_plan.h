#pragma once

#include "frangia/report/inspection_plan.h"

#include "inspect_arguments.h"

namespace frangia {

/// Reads the plan that the arguments name, and adds the sections that they name.
///
/// @errors   Error(Input) as read_inspection_plan
[[nodiscard]] InspectionPlan plan_of(const InspectArguments& arguments);

/// Takes over from a plan what the arguments do not state.
///
/// @errors   Error(Input) for an unknown unit
void apply_plan(const InspectionPlan& plan, InspectArguments& arguments);

/// A section such as "z=60", for CLI::Option::check.
[[nodiscard]] CLI::Validator a_section();

}  // namespace frangia
