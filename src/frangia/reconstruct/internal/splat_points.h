#pragma once

#include "frangia/core/image.h"
#include "frangia/geometry/mesh.h"
#include "frangia/reconstruct/internal/resample_scan.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view.h"

namespace frangia {

/// Fills the depths of the pixels onto which unorganized points project, and their colors unless
/// `color` is empty.
///
/// Each point of the front surface in a pixel is moved to the middle of the pixel along a quadratic
/// that is fitted to its neighbourhood; the depth is their mean. The nearest of them would lie in
/// front of the surface, by noise and by slope.
void splat_points(const Mesh& mesh,
                  const VirtualCamera& camera,
                  const CameraModel& model,
                  Image<float>& depth_mm,
                  Image<PixelColor>& color);

}  // namespace frangia
