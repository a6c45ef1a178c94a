#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// A closed line in space and the point that it is looked at from, as a lasso drawn on a screen.
struct ViewedOutline {
  Eigen::Vector3d eye_mm = Eigen::Vector3d::Zero();  ///< point of view
  std::vector<Eigen::Vector3d> corners_mm;           ///< at least 3, closed by the first
};

/// Selects the triangles whose centroid appears within the outline: the ray from the eye to it
/// crosses the outline's interior, even-odd. With `visible_only`, only those that face the eye and
/// that no other part of the mesh hides.
///
/// @units    mm
/// @missing  a triangle without area is not visible
/// @errors   Error(Input) when the corners do not lie on one side of the eye, so that no plane of
///           projection holds them; Error(Cancelled)
[[nodiscard]] Selection select_by_outline(const Mesh& mesh,
                                          const ViewedOutline& outline,
                                          bool visible_only,
                                          const Run& run = {});

}  // namespace frangia
