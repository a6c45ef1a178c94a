#include "frangia/reconstruct/internal/continued_surface.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "frangia/core/median.h"
#include "frangia/core/missing.h"
#include "frangia/indirect_light/extrapolate_faces.h"

namespace frangia {
namespace {

/// Median of the values that are not missing; NaN without any.
float median_of_known(const Image<float>& values) {
  std::vector<float> known;
  for (const float value : values.pixels())
    if (!std::isnan(value)) known.push_back(value);
  return known.empty() ? kMissing : median_in_place(std::span(known));
}

/// Replaces the points of a view that indirect light shifts.
void continue_faces(View& view,
                    const Image<float>& largest_shifts_mm,
                    const Image<Eigen::Vector2f>& rays) {
  const auto shifted = [](float shift) { return shift > 0.0F; };
  if (std::none_of(largest_shifts_mm.pixels().begin(), largest_shifts_mm.pixels().end(), shifted))
    return;
  const float sigma_mm = median_of_known(view.range.sigma_mm);
  const Image<float> depth_mm = extrapolate_faces(view.range, largest_shifts_mm, rays);
  for (int y = 0; y < depth_mm.height(); ++y) {
    for (int x = 0; x < depth_mm.width(); ++x) {
      if (std::isnan(depth_mm(x, y)) || depth_mm(x, y) == view.range.depth_mm(x, y)) continue;
      view.range.depth_mm(x, y) = depth_mm(x, y);
      view.range.sigma_mm(x, y) = sigma_mm;
    }
  }
}

}  // namespace

Mesh continued_surface(const MeasuredViews& measured,
                       const IndirectPart& indirect,
                       const CameraModel& camera,
                       const Image<Eigen::Vector2f>& rays,
                       const FusionOptions& fusion,
                       const Run& run) {
  ViewStore continued;
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    run.check();
    View view = measured.reference().load_points(i);
    continue_faces(view, indirect.largest_shifts_mm(view), rays);
    continued.add(view);
  }
  Run quiet;
  quiet.stop = run.stop;
  return fuse_views(continued, camera, fusion, quiet);
}

FusionOptions coarse_fusion(const MeasuredViews& measured,
                            const Image<Eigen::Vector2f>& rays,
                            FusionOptions options) {
  constexpr double kVoxel_px = 1.5;
  const auto px = static_cast<double>((rays(1, 0) - rays(0, 0)).norm());
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    const float depth_mm = median_of_known(measured.reference().load_depth_mm(i));
    if (std::isnan(depth_mm)) continue;
    options.voxel_mm = kVoxel_px * px * static_cast<double>(depth_mm);
    break;
  }
  options.add_systematic = nullptr;
  return options;
}

}  // namespace frangia
