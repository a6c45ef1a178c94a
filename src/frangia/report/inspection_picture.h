#pragma once

#include "frangia/inspect/render_mesh.h"
#include "frangia/inspection/inspect_part.h"

namespace frangia {

/// The largest deviation on a color scale, mm: `scale_mm`, or 1.5 times the tolerance where it is
/// 0.
[[nodiscard]] double deviation_scale_mm(double scale_mm, const ToleranceLimits& limits);

/// Options of a picture of the deviations of a mesh, with the tolerance band and the histogram.
/// `scale_mm` is as in `deviation_scale_mm`.
[[nodiscard]] RenderOptions deviation_picture(const Mesh& mesh,
                                              const SurfaceInspection& surface,
                                              double scale_mm = 0.0);

/// Options of a picture of the thickness, with its histogram. The scale ends at `scale_mm`, or
/// where it is 0 a tenth above 95 % of the area.
[[nodiscard]] RenderOptions thickness_picture(const Mesh& mesh,
                                              const MeasuredWalls& walls,
                                              double scale_mm = 0.0);

}  // namespace frangia
