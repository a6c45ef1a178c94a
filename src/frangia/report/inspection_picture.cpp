#include "frangia/report/inspection_picture.h"

#include <algorithm>
#include <cmath>

#include "frangia/inspect/deviation_summary.h"

namespace frangia {

double deviation_scale_mm(double scale_mm, const ToleranceLimits& limits) {
  constexpr double kBeyond = 1.5;
  if (scale_mm > 0.0) return scale_mm;
  return kBeyond * std::max(std::abs(limits.lower), std::abs(limits.upper));
}

RenderOptions deviation_picture(const Mesh& mesh,
                                const SurfaceInspection& surface,
                                double scale_mm) {
  constexpr std::size_t kBins = 60;
  RenderOptions options;
  const ToleranceLimits& limits = surface.verdict.rule.limits;
  const double scale = deviation_scale_mm(scale_mm, limits);
  options.values = surface.deviations.deviation_mm;
  options.value_max = static_cast<float>(scale);
  options.value_min = -options.value_max;
  options.color_map = ColorMap::Diverging;
  options.value_label = "deviation, mm";
  options.histogram = deviation_histogram(mesh, options.values, -scale, scale, kBins);
  options.value_limits = {limits.lower, limits.upper};
  return options;
}

RenderOptions thickness_picture(const Mesh& mesh, const MeasuredWalls& walls, double scale_mm) {
  constexpr std::size_t kBins = 60;
  RenderOptions options;
  options.values = walls.thickness.thickness_mm;
  options.value_label = "thickness, mm";
  const double top = scale_mm > 0.0                        ? scale_mm
                     : std::isfinite(walls.summary.p95_mm) ? 1.1 * walls.summary.p95_mm
                                                           : 1.0;
  options.value_max = static_cast<float>(top);
  options.histogram = deviation_histogram(mesh, options.values, 0.0, top, kBins);
  return options;
}

}  // namespace frangia
