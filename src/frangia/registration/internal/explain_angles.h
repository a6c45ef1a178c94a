#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "frangia/registration/explain/pose_explanation.h"
#include "frangia/registration/internal/assess_fit.h"
#include "frangia/registration/internal/explain_poses.h"

namespace frangia {

/// Angles that a table turned to instead of those commanded.
struct ExplainedAngles {
  std::vector<double> angles_rad;
  PoseExplanation explanation;
};

/// Looks for angles far from those commanded with which the views fit: half or double of them, the
/// other direction, a turn between two views that did not happen; or the angles to which the table
/// was refined, where they are in proportion to those commanded.
///
/// @missing  none where the angles are to be expected and hardly any point contradicts another
/// view,
///           or no such angles fit better
[[nodiscard]] std::optional<ExplainedAngles> explain_angles(const Registration& work);

/// Looks for angles off by up to 11 degrees from one view on, or over the turn in proportion, about
/// the axis to which the table was refined: those with which few points contradict another view,
/// and most surfaces fit that show how the part turned.
///
/// @missing  none where hardly any point contradicts another view, no such angles fit much better,
///           or there are several setups
[[nodiscard]] std::optional<ExplainedAngles> explain_turns(const Registration& work);

/// Tries angles; whether nothing else is then left to be explained.
using TryAngles = std::function<bool(const ExplainedAngles&)>;

/// Looks for angles about the stated axis, however far from those stated, with which the surfaces
/// of the views fit: in proportion to those commanded, off by the same from one view on, exchanged
/// between two views, of one view alone, or of any. Those that fit better than the stated ones are
/// tried, the simplest first, and the nearest to those stated of those that fit alike. Returns
/// whether the last that were tried are found; angles of any views are when none of these views
/// fits in another turn, too. `free`: poses where every view fits by itself.
[[nodiscard]] bool find_turned_views(const Registration& work,
                                     const std::optional<CorrectedPoses>& free,
                                     const TryAngles& try_angles);

}  // namespace frangia
