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

/// Withdraws the explanations of setups whose distances are relative. Each view may be off by whole
/// fringes, and the registration then reports that the part or the rig moved.
///
/// @return   whether an explanation was withdrawn, or views contradict each other
[[nodiscard]] bool withdraw_explanations(std::vector<MeasuredSetup>& setups);

/// Why the surface must not be trusted; empty when it can be. What was measured twice and differs
/// comes first: the rest follows from it. `relative`: the distances of the views are relative, and
/// the views contradict each other.
[[nodiscard]] std::string untrusted_reason_of(const Reconstruction& result, bool relative);

}  // namespace frangia
