#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/drift_model.h"

namespace frangia {

/// How the points that a rig measures move with its changes: polynomials of third degree in the
/// place, which differ from `PointDrift` by a thousandth and need no projection into changed rigs.
class DriftField {
 public:
  /// A field of no changes.
  DriftField() = default;
  /// About the state of a drift, for places near these surfels.
  DriftField(const PointDrift& drift,
             const Pattern& pattern,
             const std::vector<SurfelMap::Surfel>& surfels);

  /// The derivative of a point by the changes of the rig.
  ///
  /// @missing  zero without surfels that the changed rigs measure
  [[nodiscard]] PointDrift::Derivative of(const Eigen::Vector3d& point_mm) const;

 private:
  Eigen::MatrixXf coefficients_;  ///< 3 x changes, one below the other, x terms
  Eigen::Vector3d center_mm_ = Eigen::Vector3d::Zero();
  double radius_mm_ = 1.0;
};

}  // namespace frangia
