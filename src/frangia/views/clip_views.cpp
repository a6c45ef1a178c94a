#include "frangia/views/clip_views.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

struct Count {
  std::size_t kept = 0;
  std::size_t removed = 0;
};

Count clip_view(View& view, const Image<Eigen::Vector2f>& rays, const Clip& clip) {
  const Eigen::Isometry3d object_from_rig = view.rig_from_object.inverse();
  const Image<float>& depth = view.range.depth_mm;
  const auto keeps = [&](const Eigen::Vector2f& ray, float depth_mm) {
    const Eigen::Vector3f seen = depth_mm * ray.homogeneous();
    const Eigen::Vector3d point = object_from_rig * seen.cast<double>();
    return clip.floor.signedDistance(point) > 0.0 && point.head<2>().norm() < clip.max_radius_mm;
  };
  std::vector<Count> rows(static_cast<std::size_t>(depth.height()));
  parallel_rows(depth.height(), [&](int y) {
    Count& count = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < depth.width(); ++x) {
      if (std::isnan(depth(x, y))) continue;
      if (keeps(rays(x, y), depth(x, y))) {
        ++count.kept;
      } else {
        ++count.removed;
        view.range.remove(x, y);
      }
    }
  });
  Count all;
  const auto beyond =
      std::remove_if(view.edge_pixels.begin(), view.edge_pixels.end(), [&](const RangePixel& p) {
        return !keeps(rays(p.x, p.y), p.depth_mm);
      });
  all.removed += static_cast<std::size_t>(view.edge_pixels.end() - beyond);
  view.edge_pixels.erase(beyond, view.edge_pixels.end());
  for (const Count& row : rows) {
    all.kept += row.kept;
    all.removed += row.removed;
  }
  return all;
}

Count clip_all(ViewStore& views, const CameraModel& camera, const Clip& clip, const Run& run) {
  const auto shared_rays = views.rays(camera);
  const Image<Eigen::Vector2f>& rays = *shared_rays;
  Count all;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(views.size()));
    View view = views.load(i);
    require(same_size(view.range.depth_mm, rays),
            "clip_views: a view and the camera differ in size");
    const Count count = clip_view(view, rays, clip);
    if (count.removed > 0) views.replace(i, view);
    all.kept += count.kept;
    all.removed += count.removed;
  }
  return all;
}

}  // namespace

std::size_t clip_views_to_nothing(ViewStore& views,
                                  const CameraModel& camera,
                                  const Clip& clip,
                                  const Run& run) {
  return clip_all(views, camera, clip, run).removed;
}

std::size_t clip_views(ViewStore& views,
                       const CameraModel& camera,
                       const Clip& clip,
                       const Run& run) {
  const Count all = clip_all(views, camera, clip, run);
  require(all.kept > 0,
          "nothing is left of the object: every point lies below `clip_below` or outside of "
          "`clip_radius`; lower `clip_below` or increase `clip_radius`");
  return all.removed;
}

}  // namespace frangia
