#include "frangia/registration/internal/view_transfer.h"

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

}  // namespace frangia
