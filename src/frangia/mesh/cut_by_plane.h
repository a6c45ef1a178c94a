#pragma once

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Options of `cut_by_plane`.
struct CutOptions {
  bool capped = false;  ///< close the cut with flat triangles marked as synthesized
};

/// Keeps the part of a mesh on the positive side of a plane and cuts the triangles at the plane.
///
/// A vertex on a cut edge interpolates the position and the data of the ends of the edge. An
/// outline of the cut that intersects itself stays open; `run` warns of it.
///
/// @units    mm; the normal of the plane has unit length
/// @errors   Error(Cancelled)
[[nodiscard]] Mesh cut_by_plane(Mesh mesh,
                                const Eigen::Hyperplane<double, 3>& plane,
                                const CutOptions& options = {},
                                const Run& run = {});

}  // namespace frangia
