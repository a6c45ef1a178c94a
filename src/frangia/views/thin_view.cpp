#include "frangia/views/thin_view.h"

#include <algorithm>
#include <cmath>

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

}  // namespace frangia
