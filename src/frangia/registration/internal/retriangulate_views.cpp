#include "frangia/registration/internal/retriangulate_views.h"

#include <cmath>
#include <utility>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"
#include "frangia/views/view_store.h"

namespace frangia {

namespace {

/// The rays of both cameras.
struct RaysOfRigs {
  Image<Eigen::Vector2f> from;
  Image<Eigen::Vector2f> to;
};

View triangulated_again(View view,
                        const Pattern& pattern,
                        const Projector& from,
                        const Projector& to,
                        const RaysOfRigs& rays) {
  RangeGrid& range = view.range;
  const auto again = [&](int x, int y, float depth) {
    const Eigen::Vector3d point =
        static_cast<double>(depth) * rays.from(x, y).cast<double>().homogeneous();
    const double phase_rad = phase_at(point, pattern, from);
    return static_cast<float>(
        intersect_fringe(rays.to(x, y).cast<double>(), phase_rad, pattern, to).depth_mm);
  };
  for (RangePixel& pixel : view.edge_pixels)
    pixel.depth_mm = again(pixel.x, pixel.y, pixel.depth_mm);
  std::erase_if(view.edge_pixels, [](const RangePixel& p) { return std::isnan(p.depth_mm); });
  parallel_rows(range.depth_mm.height(), [&](int y) {
    for (int x = 0; x < range.depth_mm.width(); ++x) {
      if (std::isnan(range.depth_mm(x, y))) continue;
      const float depth_mm = again(x, y, range.depth_mm(x, y));
      if (std::isnan(depth_mm)) {
        range.remove(x, y);
      } else {
        range.depth_mm(x, y) = depth_mm;
      }
    }
  });
  return view;
}

}  // namespace

View retriangulate(View view, const Pattern& pattern, const Rig& from, const Rig& to) {
  return triangulated_again(std::move(view),
                            pattern,
                            from.projector,
                            to.projector,
                            {rays_of(from.reference().model), rays_of(to.reference().model)});
}

ViewStore retriangulate_views(const ViewStore& views,
                              const Pattern& pattern,
                              const Rig& from,
                              const Rig& to,
                              const Run& run) {
  const RaysOfRigs rays{rays_of(from.reference().model), rays_of(to.reference().model)};
  ViewStore out;
  load_each_view(views, [&](std::size_t /*index*/, View& view) {
    run.check();
    out.add(triangulated_again(std::move(view), pattern, from.projector, to.projector, rays));
  });
  return out;
}

}  // namespace frangia
