#include "frangia/registration/internal/view_transfer.h"

#include <cmath>
#include <utility>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"
#include "frangia/views/view_store.h"

namespace frangia {

ViewTransfer::ViewTransfer(const TableState& state, std::size_t from, std::size_t to)
    : back_(Eigen::AngleAxisd(-state.angles_rad[from], state.table.axis).matrix()),
      forth_(Eigen::AngleAxisd(state.angles_rad[to], state.table.axis).matrix()),
      across_setups_(state.part_pose(state.setup_of(to)) *
                     state.part_pose(state.setup_of(from)).inverse()),
      rotation_(forth_ * across_setups_.linear() * back_),
      center_(state.table.point_mm),
      axis_(state.table.axis),
      sideways_(perpendicular_directions(state.table)) {}

PairJacobian ViewTransfer::jacobian(const Eigen::Vector3d& normal,
                                    const Eigen::Vector3d& point) const {
  const Eigen::Vector3d seen = point - center_;
  const Eigen::Vector3d start = back_ * seen;
  const Eigen::Vector3d end = in_other_setup(point);
  const Eigen::Vector3d arrived = forth_ * end;
  const Eigen::Vector3d at_end = forth_.transpose() * normal;
  const Eigen::Vector3d at_start = across_setups_.linear().transpose() * at_end;
  const Eigen::Vector3d at_seen = back_.transpose() * at_start;
  const Eigen::Vector3d turned = arrived.cross(normal);
  PairJacobian by;
  by.tilt = sideways_.transpose() *
            (turned - end.cross(at_end) + start.cross(at_start) - seen.cross(at_seen));
  by.shift = sideways_.transpose() * (normal - at_end + at_start - at_seen);
  by.angle_to = axis_.dot(turned);
  by.angle_from = -axis_.dot(start.cross(at_start));
  by.setup_to << at_end, end.cross(at_end);
  by.setup_from << -at_start, -start.cross(at_start);
  return by;
}

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
