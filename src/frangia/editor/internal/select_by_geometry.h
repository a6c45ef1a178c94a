#pragma once

#include <Eigen/Geometry>

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

}  // namespace frangia
