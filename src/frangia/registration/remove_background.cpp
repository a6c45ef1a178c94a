#include <algorithm>
#include <cmath>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/registration/find_background.h"

namespace frangia {
namespace {

constexpr float kNoises = 5.0F;           // standard deviations: of a million points none is beyond
constexpr float kRelativeMargin = 1e-3F;  // of the distance: twice what counts as equal

constexpr float kRelativeStep = 0.02F;  // of the distance: more is a step between two surfaces

/// The depths of the background about a pixel.
struct BackgroundDepths {
  float nearest_mm = INFINITY;
  float farthest_mm = 0.0F;
  bool all_around = true;  ///< whether it is on all sides of the pixel
};

BackgroundDepths depths_about(const Background& background, int x, int y) {
  const Image<float>& depth_mm = background.depth_mm;
  const int left = x / background.step_px;
  const int top = y / background.step_px;
  BackgroundDepths out;
  // One pixel more on each side: the border of the background lies between pixels of its map.
  for (int v = std::max(0, top - 1); v <= std::min(depth_mm.height() - 1, top + 2); ++v) {
    for (int u = std::max(0, left - 1); u <= std::min(depth_mm.width() - 1, left + 2); ++u) {
      const float z = depth_mm(u, v);
      const bool beside = u >= left && u <= left + 1 && v >= top && v <= top + 1;
      out.all_around = out.all_around && !(beside && std::isnan(z));
      if (std::isnan(z)) continue;
      out.nearest_mm = std::min(out.nearest_mm, z);
      out.farthest_mm = std::max(out.farthest_mm, z);
    }
  }
  return out;
}

bool is_background(const BackgroundDepths& at, float depth_mm, float sigma_mm) {
  if (at.farthest_mm == 0.0F) return false;
  float margin_mm = kNoises * sigma_mm + kRelativeMargin * depth_mm;
  // At the border a surface goes on as steep as it is; a step between two surfaces does not.
  const float spread_mm = at.farthest_mm - at.nearest_mm;
  if (!at.all_around && spread_mm < kRelativeStep * depth_mm) margin_mm += spread_mm;
  if (depth_mm < at.nearest_mm - margin_mm) return false;
  return at.all_around || depth_mm < at.farthest_mm + margin_mm;
}

std::size_t remove_from(View& view, const Background& background) {
  RangeGrid& range = view.range;
  std::vector<std::size_t> rows(static_cast<std::size_t>(range.depth_mm.height()));
  parallel_rows(range.depth_mm.height(), [&](int y) {
    for (int x = 0; x < range.depth_mm.width(); ++x) {
      const float depth_mm = range.depth_mm(x, y);
      if (std::isnan(depth_mm) ||
          !is_background(depths_about(background, x, y), depth_mm, range.sigma_mm(x, y)))
        continue;
      range.remove(x, y);
      ++rows[static_cast<std::size_t>(y)];
    }
  });
  std::size_t removed = std::erase_if(view.edge_pixels, [&](const RangePixel& p) {
    return is_background(depths_about(background, p.x, p.y), p.depth_mm, p.sigma_mm);
  });
  for (const std::size_t row : rows)
    removed += row;
  return removed;
}

}  // namespace

std::size_t remove_background(ViewStore& views,
                              const CameraModel& camera,
                              const Background& background,
                              const Run& run) {
  if (!background.found()) return 0;
  std::size_t removed = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.check();
    View view = views.load(i);
    require(view.range.depth_mm.width() == camera.width_px &&
                view.range.depth_mm.height() == camera.height_px,
            "remove_background: a view and the camera differ in size");
    const std::size_t of_view = remove_from(view, background);
    if (of_view > 0) views.replace(i, view);
    removed += of_view;
  }
  return removed;
}

std::size_t clip_background(ViewStore& views, const CameraModel& camera, const Run& run) {
  const std::vector<int> setups(views.size(), 0);
  return remove_background(views, camera, find_background(views, camera, setups, run), run);
}

}  // namespace frangia
