#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/reconstruct/internal/indirect_part.h"
#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// Fuses the views with the points that indirect light shifts replaced by the faces around them
/// (`extrapolate_faces`). This surface predicts indirect light, and nothing else: near a crease the
/// measured one is shifted by millimetres or missing, so that its own prediction is wrong there.
///
/// @errors   as fuse_views
[[nodiscard]] Mesh continued_surface(const MeasuredViews& measured,
                                     const IndirectPart& indirect,
                                     const CameraModel& camera,
                                     const Image<Eigen::Vector2f>& rays,
                                     const FusionOptions& fusion,
                                     const Run& run);

/// Options for a surface of one and a half pixels between samples, as fine as a crease needs,
/// without systematic parts.
[[nodiscard]] FusionOptions coarse_fusion(const MeasuredViews& measured,
                                          const Image<Eigen::Vector2f>& rays,
                                          FusionOptions options);

}  // namespace frangia
