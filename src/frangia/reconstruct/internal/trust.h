#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/reconstruct/internal/split_setups.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/registration/registration_report.h"

namespace frangia {

/// Whether the views say that the rig is not what it states, and nothing else.
[[nodiscard]] bool blames_rig(const std::optional<RegistrationReport>& registration);

/// Names the copies among the views that are left out because they contradict the others.
void warn_of_copies(std::span<const ViewSummary> views, const Run& run);

/// Takes back what moved in views whose distances nothing makes absolute: each may be wrong by
/// whole fringes, which looks like a part or a rig that moved. Returns whether any is said to have
/// moved, or contradicts the others.
[[nodiscard]] bool take_back_poses_of_relative_distances(std::vector<MeasuredSetup>& setups);

/// Why the surface must not be trusted; empty when it can be. What was measured twice and differs
/// comes first: the rest follows from it. `relative`: distances are, and contradict each other.
[[nodiscard]] std::string untrusted_reason_of(const Reconstruction& result, bool relative);

}  // namespace frangia
