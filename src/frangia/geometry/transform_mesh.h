#pragma once

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// The mesh moved as a whole. Nothing is marked: the part is the same, only its frame is another.
[[nodiscard]] Mesh transform_mesh(Mesh mesh, const Eigen::Isometry3d& target_from_mesh);

/// The mesh as a mirror in this plane shows it, still facing outwards.
[[nodiscard]] Mesh mirror_mesh(Mesh mesh, const Eigen::Hyperplane<double, 3>& plane);

/// The plane through the selected triangles by least squares, weighted by area, its normal on their
/// outer side.
///
/// errors   Error(Input) when nothing with an area is selected
[[nodiscard]] Eigen::Hyperplane<double, 3> fit_plane(const Mesh& mesh, const Selection& selection);

/// The flat face about a picked position: the triangles that hang together with the one nearest to
/// it and turn from it by no more than an angle.
///
/// errors   Error(Input) when the mesh is empty
[[nodiscard]] Selection select_face(const Mesh& mesh,
                                    const Eigen::Vector3d& picked_mm,
                                    double within_rad = 0.17);

/// The frame in which the first face looks along -z and lies in z = 0, the second looks along -x
/// and lies in x = 0, and the third lies in y = 0: the 3-2-1 alignment of measuring machines.
///
/// shape    the normals are those of the faces, outwards; they need not be square to each other
/// errors   Error(Input) when two of the faces are parallel
[[nodiscard]] Eigen::Isometry3d align_faces(const Eigen::Hyperplane<double, 3>& first,
                                            const Eigen::Hyperplane<double, 3>& second,
                                            const Eigen::Hyperplane<double, 3>& third);

}  // namespace frangia
