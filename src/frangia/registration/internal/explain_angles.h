#pragma once

#include <optional>
#include <vector>

#include "frangia/registration/explain/pose_explanation.h"
#include "frangia/registration/internal/leave_out_views.h"

namespace frangia {

/// Angles that a table turned to instead of those commanded.
struct ExplainedAngles {
  std::vector<double> angles_rad;
  PoseExplanation explanation;
};

/// Looks for angles far from those commanded with which the views fit: half or double of them, the
/// other direction, or a turn between two views that did not happen.
///
/// @missing  none where hardly any point contradicts another view, or no such angles fit better
[[nodiscard]] std::optional<ExplainedAngles> explain_angles(const Registration& work);

}  // namespace frangia
