#include "frangia/fusion/internal/measure_sampling.h"

#include <algorithm>
#include <vector>

namespace frangia {
namespace {

float median(std::vector<float>& values) {
  if (values.empty()) return 0.0F;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Sampling measure_sampling(const ViewStore& views, const CameraRays& camera, const Run& run) {
  constexpr int kRows = 16;
  std::vector<float> gaps;
  std::vector<float> sigmas;
  Sampling sampling;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.check();
    const RangeGrid range = views.load_points(i).range;
    require(same_size(range.depth_mm, camera.rays),
            "a view's size is not that of the rig's camera");
    const auto point = [&](int x, int y) -> Eigen::Vector3f {
      return range.depth_mm(x, y) * camera.rays(x, y).homogeneous();
    };
    for (int y = kRows / 2; y < range.depth_mm.height(); y += kRows) {
      for (int x = 0; x + 1 < range.depth_mm.width(); ++x) {
        if (!(range.depth_mm(x, y) > 0.0F)) continue;
        ++sampling.points;
        sigmas.push_back(range.sigma_mm(x, y));
        if (range.depth_mm(x + 1, y) > 0.0F) gaps.push_back((point(x + 1, y) - point(x, y)).norm());
      }
    }
  }
  sampling.points *= kRows;
  sampling.spacing_mm = median(gaps);
  sampling.sigma_mm = median(sigmas);
  return sampling;
}

}  // namespace frangia
