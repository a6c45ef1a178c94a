#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The shares of the views in some vertices of a mesh that was fused from them: proportional to
/// cos^2/sigma^2 of the views that measured the vertex. A vertex that no view measured, such as one
/// of a bridged gap, counts with all views that it faces.
///
/// @shape    `vertices`: numbers; a row for each view of the turntable and a column for each of
///           `vertices`, which sums up to 1, or to 0 where no view faces the vertex
[[nodiscard]] Eigen::MatrixXf view_weights(const Mesh& mesh,
                                           const std::vector<std::size_t>& vertices,
                                           const std::vector<CameraViews>& cameras,
                                           const Run& run);

}  // namespace frangia
