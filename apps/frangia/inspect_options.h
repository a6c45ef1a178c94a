#pragma once

#include <CLI/CLI.hpp>

#include "frangia/inspection/inspection_plan.h"

#include "inspect_arguments.h"

namespace frangia {

/// Adds the options of `frangia inspect` to the verb.
void add_inspect_options(CLI::App& verb, InspectArguments& arguments);

/// Checks before the work that the options of the plan and of the command line go together.
///
/// @errors   kind Input or usage, with what to add or leave out
void check_inspect_arguments(const InspectArguments& arguments, const InspectionPlan& plan);

}  // namespace frangia
