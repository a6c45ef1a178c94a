#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Selects the triangles whose centroid lies on the positive side of a plane.
///
/// @units    mm; the normal of the plane has unit length
[[nodiscard]] Selection select_by_plane(const Mesh& mesh,
                                        const Eigen::Hyperplane<double, 3>& plane);

/// Selects the triangles whose centroid lies in a box.
[[nodiscard]] Selection select_by_box(const Mesh& mesh, const Eigen::AlignedBox3d& box_mm);

/// Selects the triangles whose centroid lies in a ball.
[[nodiscard]] Selection select_by_ball(const Mesh& mesh,
                                       const Eigen::Vector3d& center_mm,
                                       double radius_mm);

/// Selects the triangles whose normal is within an angle of a direction.
///
/// @missing  a triangle without area is not selected
/// @errors   Error(Input) for a direction of length 0
[[nodiscard]] Selection select_by_normal(const Mesh& mesh,
                                         const Eigen::Vector3d& direction,
                                         double within_rad);

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
