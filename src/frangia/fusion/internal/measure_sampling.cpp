#include "frangia/fusion/internal/measure_sampling.h"

#include <span>
#include <vector>

#include "frangia/core/median.h"
#include "frangia/views/load_each_view.h"

namespace frangia {
Sampling measure_sampling(const ViewStore& views, const CameraRays& camera, const Run& run) {
  constexpr int kRows = 16;
  std::vector<float> gaps;
  std::vector<float> sigmas;
  Sampling sampling;
  load_each_view(views, [&](std::size_t /*index*/, const View& view) {
    run.check();
    const RangeGrid& range = view.range;
    require(same_size(range.depth_mm, camera.rays),
            "the size of a view differs from that of the rig's camera");
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
  });
  sampling.points *= kRows;
  sampling.spacing_mm = median_in_place(std::span(gaps));
  sampling.sigma_mm = median_in_place(std::span(sigmas));
  return sampling;
}

}  // namespace frangia
