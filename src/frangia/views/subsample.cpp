#include "frangia/views/subsample.h"

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

int thinned(int pixels, int step) {
  return (pixels + step - 1) / step;
}

Image<float> subsample(const Image<float>& image, int step) {
  Image<float> out(thinned(image.width(), step), thinned(image.height(), step), Uninitialized{});
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x)
      out(x, y) = image(x * step, y * step);
  });
  return out;
}

}  // namespace

CameraModel subsample(const CameraModel& camera, int step) {
  require(step >= 1, "subsample: the step is at least one pixel");
  CameraModel thin = camera;
  thin.width_px = thinned(camera.width_px, step);
  thin.height_px = thinned(camera.height_px, step);
  thin.focal_px /= step;
  thin.principal_point_px /= step;
  return thin;
}

View subsample(const View& view, int step) {
  require(step >= 1, "subsample: the step is at least one pixel");
  View thin;
  thin.rig_from_object = view.rig_from_object;
  thin.range.depth_mm = subsample(view.range.depth_mm, step);
  thin.range.sigma_mm = subsample(view.range.sigma_mm, step);
  return thin;
}

}  // namespace frangia
