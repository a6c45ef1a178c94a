#pragma once

#include "frangia/inspection/inspection_plan.h"

#include "inspect_arguments.h"
#include "terminal.h"

namespace frangia {

/// Inspects each mesh by the plan and writes the table of `--batch`.
void inspect_batch(const InspectArguments& arguments,
                   const InspectionPlan& plan,
                   Terminal& terminal);

}  // namespace frangia
