#include "frangia/views/thin_view.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/error.h"
#include "frangia/core/image.h"

namespace frangia {

int thinning_step(const CameraModel& camera, double pixels) {
  const double all = static_cast<double>(camera.width_px) * camera.height_px;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(all / pixels))));
}

CameraModel thinned(CameraModel camera, int step) {
  camera.width_px = (camera.width_px + step - 1) / step;
  camera.height_px = (camera.height_px + step - 1) / step;
  camera.focal_px /= step;
  camera.principal_point_px /= step;
  return camera;
}

RangeGrid thinned(const RangeGrid& range, int step) {
  const int width = (range.depth_mm.width() + step - 1) / step;
  const int height = (range.depth_mm.height() + step - 1) / step;
  RangeGrid out{Image<float>(width, height), Image<float>(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      out.depth_mm(x, y) = range.depth_mm(x * step, y * step);
      out.sigma_mm(x, y) = range.sigma_mm(x * step, y * step);
    }
  }
  return out;
}

namespace {

int subsampled_size(int pixels, int step) {
  return (pixels + step - 1) / step;
}

}  // namespace

CameraModel subsample(const CameraModel& camera, int step) {
  require(step >= 1, "subsample: the step must be at least one pixel");
  CameraModel out = camera;
  out.width_px = subsampled_size(camera.width_px, step);
  out.height_px = subsampled_size(camera.height_px, step);
  out.focal_px /= step;
  out.principal_point_px /= step;
  return out;
}

View subsample(const View& view, int step) {
  require(step >= 1, "subsample: the step must be at least one pixel");
  View out;
  out.rig_from_object = view.rig_from_object;
  out.range.depth_mm = every_nth_pixel(view.range.depth_mm, step);
  out.range.sigma_mm = every_nth_pixel(view.range.sigma_mm, step);
  if (!view.range.phase_rad.empty())
    out.range.phase_rad = every_nth_pixel(view.range.phase_rad, step);
  if (!view.range.systematic_mm.empty())
    out.range.systematic_mm = every_nth_pixel(view.range.systematic_mm, step);
  return out;
}

}  // namespace frangia
