#include <optional>
#include <utility>
#include <vector>

#include "frangia/registration/internal/assess_fit.h"
#include "frangia/registration/internal/explain_angles.h"
#include "frangia/registration/internal/explain_poses.h"

namespace frangia {
namespace {

void take_angles(Registration& work, const ExplainedAngles& angles) {
  work.bundle.given.angles_rad = angles.angles_rad;
  if (angles.explanation.best == PoseCause::AnglesScaled)
    work.angle_factor = angles.explanation.scale;
  work.optimize_again();
}

/// Whether views may be far from where they belong, where no cause is linear in what moves them.
bool may_be_far(const ExplainedPoses& found, const Registration& work) {
  switch (found.explanation.best) {
    case PoseCause::AsStated:
      return !fits_by_table(work);
    case PoseCause::ViewMoved:
    case PoseCause::ViewsMoved:
    case PoseCause::PartMovedTwice:
    case PoseCause::Wobble:
    case PoseCause::Unexplained:
      return true;
    default:
      return !found.explanation.decided || !(found.fits || fits_by_table(work));
  }
}

/// Angles far from those stated with which nothing else is left to be explained; the simplest of
/// them, about which the views are then registered.
std::optional<ExplainedPoses> explain_by_angles(RegistrationReport& report,
                                                Registration& work,
                                                const ExplainedPoses& before,
                                                const TurntableStations& given,
                                                std::size_t dense) {
  std::optional<ExplainedPoses> found;
  std::optional<Registration> turned;
  PoseExplanation explanation;
  const bool is_found =
      find_turned_views(work, before.corrected, [&](const ExplainedAngles& angles) {
        turned.emplace(work);
        take_angles(*turned, angles);
        if (!fits_by_table(*turned) || !leaves_nothing_to_explain(*turned, given)) return false;
        found = explain_poses(*turned, given, dense);
        explanation = angles.explanation;
        return true;
      });
  if (!is_found) return std::nullopt;
  report.explanation = std::move(explanation);
  work.bundle = std::move(turned->bundle);
  work.angle_factor = turned->angle_factor;
  return found;
}

}  // namespace

ExplainedPoses explain_registration(RegistrationReport& report,
                                    Registration& work,
                                    const TurntableStations& given,
                                    std::size_t dense) {
  std::optional<ExplainedAngles> angles = explain_angles(work);
  if (!angles) angles = explain_turns(work);
  if (angles) {
    report.explanation = angles->explanation;
    take_angles(work, *angles);
  }
  for (;;) {
    ExplainedPoses found = explain_poses(work, given, dense);
    const PoseExplanation& explanation = found.explanation;
    if (may_be_far(found, work)) {
      if (auto turned = explain_by_angles(report, work, found, given, dense))
        return std::move(*turned);
    }
    if (explanation.best != PoseCause::AsStated) report.explanation = explanation;
    const bool leaves_out = explanation.best == PoseCause::ViewMoved && explanation.decided &&
                            2 * (report.outliers.size() + 1) < work.views.size();
    if (!leaves_out) return found;
    work.run.warn(explanation.text);
    const std::size_t view = explanation.views.front();
    report.outliers.push_back(view);
    work.leave_out(view);
    work.optimize_again();
  }
}

}  // namespace frangia
