#include "frangia/registration/internal/retriangulate_views.h"

#include <cmath>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/fringe_ray.h"
#include "frangia/views/load_each_view.h"

namespace frangia {

ViewStore retriangulate_views(const ViewStore& views,
                              const Pattern& pattern,
                              const Rig& from,
                              const Rig& to,
                              const Run& run) {
  const Image<Eigen::Vector2f> rays_from = rays_of(from.camera.model);
  const Image<Eigen::Vector2f> rays_to = rays_of(to.camera.model);
  ViewStore out;
  load_each_view(views, [&](std::size_t /*index*/, View& view) {
    run.check();
    RangeGrid& range = view.range;
    view.edge_pixels.clear();
    parallel_rows(range.depth_mm.height(), [&](int y) {
      for (int x = 0; x < range.depth_mm.width(); ++x) {
        const double depth_mm = static_cast<double>(range.depth_mm(x, y));
        if (std::isnan(depth_mm)) continue;
        const Eigen::Vector3d point = depth_mm * rays_from(x, y).cast<double>().homogeneous();
        const double phase_rad = phase_at(point, pattern, from.projector);
        const RayDepth found =
            intersect_fringe(rays_to(x, y).cast<double>(), phase_rad, pattern, to.projector);
        if (std::isnan(found.depth_mm)) {
          range.remove(x, y);
        } else {
          range.depth_mm(x, y) = static_cast<float>(found.depth_mm);
        }
      }
    });
    out.add(view);
  });
  return out;
}

}  // namespace frangia
