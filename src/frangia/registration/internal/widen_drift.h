#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "frangia/registration/internal/drift_bundle.h"

namespace frangia {

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

}  // namespace frangia
