#pragma once

#include <cstddef>
#include <filesystem>

#include "frangia/acceptance/acceptance_plan.h"
#include "frangia/rig/rig.h"

#include "terminal.h"

namespace frangia {

/// The rig of a plan: a file, or a built-in rig for a simulation.
///
/// @errors   as read_rig and rig_preset
[[nodiscard]] Rig acceptance_rig(const AcceptancePlan& plan, const Run& run);

/// Makes the scan of an arrangement where it does not exist: renders it, or asks the operator to
/// place the artifact and captures it. Returns its folder.
///
/// @errors   Error(Input) where a folder of the plan is missing; Error(Cancelled) when the operator
///           ends the test, with the command that continues it; as simulate_scan and capture_scan
[[nodiscard]] std::filesystem::path acceptance_scan(const AcceptancePlan& plan,
                                                    const Rig& rig,
                                                    std::size_t arrangement,
                                                    const std::filesystem::path& output,
                                                    Terminal& terminal);

}  // namespace frangia
