#include "frangia/views/subsample.h"

#include "frangia/core/error.h"
#include "frangia/core/every_nth_pixel.h"

namespace frangia {
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
