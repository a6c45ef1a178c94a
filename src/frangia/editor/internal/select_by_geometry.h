#pragma once

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// The triangles whose centre lies on the plane's positive side.
///
/// units    mm; the plane's normal is unit
[[nodiscard]] Selection select_by_plane(const Mesh& mesh,
                                        const Eigen::Hyperplane<double, 3>& plane);

/// The triangles whose centre lies in the box.
[[nodiscard]] Selection select_by_box(const Mesh& mesh, const Eigen::AlignedBox3d& box_mm);

/// The triangles whose centre lies within a ball.
[[nodiscard]] Selection select_by_ball(const Mesh& mesh,
                                       const Eigen::Vector3d& center_mm,
                                       double radius_mm);

/// The triangles whose normal is within an angle of a direction; one without area is not.
///
/// errors   Error(Input) when the direction has no length
[[nodiscard]] Selection select_by_normal(const Mesh& mesh,
                                         const Eigen::Vector3d& direction,
                                         double within_rad);

}  // namespace frangia
