#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/registration/internal/drift_bundle.h"
#include "frangia/registration/internal/view_pairs.h"
#include "frangia/registration/refine_rig.h"

namespace frangia {

/// The surfel maps of all surfaces, one after the other, triangulated by `rig`; with `changed`
/// false, `rig` is the given one and nothing is triangulated.
[[nodiscard]] std::vector<DriftView> drift_views(std::span<const RigSurfaces> surfaces,
                                                 const Rig& given,
                                                 const Rig& rig,
                                                 bool changed,
                                                 const Run& run);

/// Sets how the points of the views move about a state.
void differentiate(std::vector<DriftView>& views,
                   std::span<const RigSurfaces> surfaces,
                   const PointDrift& drift);

/// The views of the same setup that overlap; without a turntable, those of one station.
[[nodiscard]] ViewPairs comparable_pairs(const std::vector<DriftView>& views,
                                         std::span<const Station> stations,
                                         const TableState& table,
                                         const FastCameraModel& camera,
                                         bool turns);

/// Medians over some surfels of all views.
struct SurfelScale {
  double distance_mm = 0.0;  ///< from the camera
  double sigma_mm = 0.0;     ///< of a surfel
};

/// @errors   Error(Numeric) when the views hold no surfel
[[nodiscard]] SurfelScale scale_of(const std::vector<DriftView>& views);

/// The hypotheses of how far a rig is from what it states: as far as its standard deviations allow,
/// or farther in one group of parameters, such as those of one lens, or in all.
struct DriftHypotheses {
  std::vector<std::vector<Eigen::Index>> groups;  ///< parameters that change together
  Eigen::Index parameters = 0;
  /// The factor of the covariance of w, in its present units, whose standard deviations are wider
  /// by these factors.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& widening)> factor;
};

/// Factors by which the standard deviations of the parameters are wider than stated: root mean
/// square over the hypotheses, by their evidence. What a wrong lens changes beyond what surfaces
/// determine is then open for that lens, and not for the others.
///
/// @shape    `evidence` about `w`
[[nodiscard]] Eigen::VectorXd widening_by_evidence(const DriftHypotheses& hypotheses,
                                                   const DriftEvidence& evidence,
                                                   const Eigen::VectorXd& w);

/// Twice the loss that the most probable change of the rig spares against `w`, where the standard
/// deviations are wider by these factors: the sum of the squares, over their variances, of what it
/// changes in the pairs.
[[nodiscard]] double gain_by_widening(const DriftHypotheses& hypotheses,
                                      const DriftEvidence& evidence,
                                      const Eigen::VectorXd& w,
                                      const Eigen::VectorXd& widening);

}  // namespace frangia
