#pragma once

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

struct CutOptions {
  bool capped = false;  ///< close what the cut opens, with flat triangles marked as invented
};

/// What of the mesh lies on the plane's positive side; triangles that it crosses are cut.
///
/// A vertex on a cut edge is a mean of its ends, with their sigma, views and marks. A cut that
/// crosses itself stays open; a warning of `run` says so.
/// units    mm; the plane's normal is unit
[[nodiscard]] Mesh cut_by_plane(Mesh mesh,
                                const Eigen::Hyperplane<double, 3>& plane,
                                const CutOptions& options = {},
                                const Run& run = {});

}  // namespace frangia
