#pragma once

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Applies a rigid transform to a mesh. Marks do not change, since only the frame does.
///
/// @units    mm
[[nodiscard]] Mesh transform_mesh(Mesh mesh, const Eigen::Isometry3d& target_from_mesh);

/// Reflects a mesh in a plane. Triangles stay oriented outwards.
[[nodiscard]] Mesh mirror_mesh(Mesh mesh, const Eigen::Hyperplane<double, 3>& plane);

/// Fits a plane to the selected triangles by area-weighted least squares. Its normal points
/// outwards.
///
/// @errors   Error(Input) when the selection has not one flag for each triangle, or no area
[[nodiscard]] Eigen::Hyperplane<double, 3> fit_plane(const Mesh& mesh, const Selection& selection);

/// Selects the flat face around a point: the triangles connected to the one nearest to the point
/// whose normals differ from its normal by no more than `within_rad`.
///
/// @errors   Error(Input) when the mesh is empty
[[nodiscard]] Selection select_face(const Mesh& mesh,
                                    const Eigen::Vector3d& picked_mm,
                                    double within_rad = 0.17);

/// Computes the 3-2-1 alignment of three faces. All three pass through the origin. The outward
/// normal of the first one is -z. The second one's is -x, apart from its deviation from a right
/// angle to the first. The third one's is close to -y or +y.
///
/// @shape    outward normals, which need not be perpendicular
/// @errors   Error(Input) when two faces are parallel, or the third one is parallel to the
///          intersection of the others
[[nodiscard]] Eigen::Isometry3d align_faces(const Eigen::Hyperplane<double, 3>& first,
                                            const Eigen::Hyperplane<double, 3>& second,
                                            const Eigen::Hyperplane<double, 3>& third);

}  // namespace frangia
