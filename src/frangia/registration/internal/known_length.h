#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/fit_primitives.h"
#include "frangia/registration/internal/drift_bundle.h"
#include "frangia/registration/refine_rig.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What the known distance of two balls says about a rig.
struct KnownLength {
  double scale = 1.0;           ///< known over measured distance
  Eigen::MatrixXd information;  ///< about the changes of the rig, in units of their prior
};

/// Finds the ball bar on the surfaces of all views, in the state of the bundle.
///
/// @errors   Error(Input) when there are no two balls, or their distance differs from the known one
///           by more than `max_scale_error`
[[nodiscard]] KnownLength measure_known_length(const DriftBundle& bundle,
                                               const RefineRigOptions& options);

/// Multiplies all lengths of a rig, so that all that it measures grows alike.
void scale_rig(Rig& rig, double factor);

/// A point of a surface and its unit normal, outwards.
struct OrientedPoint {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// One ball of a ball bar, and the points on it.
struct BarBall {
  Sphere sphere;
  std::vector<std::size_t> points;  ///< indices
};

/// The two balls of a ball bar.
struct BallPair {
  BarBall first;
  BarBall second;

  [[nodiscard]] double distance_mm() const {
    return (first.sphere.center_mm - second.sphere.center_mm).norm();
  }
};

/// Finds the two balls that hold most of some points. Planes, cylinders and the rest of the part do
/// not matter as long as each ball holds a twentieth of the points.
///
/// @missing  empty when there are no two such balls
/// @source   RANSAC over pairs of oriented points, with a fixed sequence of pairs; `fit_sphere`
[[nodiscard]] std::optional<BallPair> find_ball_pair(std::span<const OrientedPoint> points);

}  // namespace frangia
