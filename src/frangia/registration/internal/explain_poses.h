#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/explain/pose_explanation.h"
#include "frangia/registration/internal/assess_fit.h"
#include "frangia/registration/register_views.h"
#include "frangia/registration/view_motions.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {

/// Poses of views that the table alone does not explain.
struct CorrectedPoses {
  TableState state;                                ///< axis and angles that remain
  std::vector<Eigen::Isometry3d> object_from_rig;  ///< of each view
  BundleSums fit;                                  ///< of all pairs in these poses
  BundleSums wide;                                 ///< the same within a wider gate
  /// By what the explanation leaves open, and by what others say instead.
  ViewMotions motions;
};

/// The explanation of a registration, and what follows from it.
struct ExplainedPoses {
  PoseExplanation explanation;
  std::optional<CorrectedPoses> corrected{};
  std::vector<Rig> rigs{};  ///< of each view, where the rig drifts
  /// Whether `fits` holds in the poses of `corrected`, or with `rigs`.
  bool fits = false;
  /// By what the views leave open between causes, where the poses are not corrected; those of
  /// `corrected` have it.
  ViewMotions spread{};
  /// Of the rig that measured the points, by the causes that change it; empty: none is probable.
  RigCovariance rig_open{};
};

/// Explains what the views of a registration disagree about, after its table has been refined.
///
/// Where nothing contradicts the table, one pass over the pairs says so. Else every view gets a
/// free pose, the pairs of that fit are kept, and all hypotheses are scored on them.
///
/// @shape    `dense`: the surfels that refine the corrected poses
[[nodiscard]] ExplainedPoses explain_poses(const Registration& work,
                                           const TurntableStations& given,
                                           std::size_t dense);

/// Whether the table places the views where no cause would be looked for: what `explain_poses`
/// finds is as stated then.
[[nodiscard]] bool leaves_nothing_to_explain(const Registration& work,
                                             const TurntableStations& given);

/// Explains what the views disagree about, by angles far from those stated or as `explain_poses`,
/// and refines the table about what is found. A view that is elsewhere by itself is left out, and
/// the others are explained again.
[[nodiscard]] ExplainedPoses explain_registration(RegistrationReport& report,
                                                  Registration& work,
                                                  const TurntableStations& given,
                                                  std::size_t dense);

}  // namespace frangia
