#pragma once

#include <functional>
#include <string>

#include "frangia/registration/explain/pose_explanation.h"
#include "frangia/registration/register_views.h"

namespace frangia {

/// Names of views by their index.
using ViewNames = std::function<std::string(std::size_t)>;

/// One sentence without a full stop about what an explanation found; empty when all is as stated.
[[nodiscard]] std::string describe(const PoseExplanation& found, const ViewNames& names);

/// What to do about it, as a clause; empty for nothing.
[[nodiscard]] std::string remedy_of(const PoseExplanation& found, WrongRig wrong_rig);

}  // namespace frangia
