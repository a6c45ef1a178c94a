#include "frangia/registration/turntable_of_poses.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

/// Motion of the part between two views, in the rig frame, and the turn that was commanded.
struct Turn {
  Eigen::Isometry3d motion;
  double angle_rad = 0.0;
};

/// Twice the sine of a rotation's angle times its axis.
Eigen::Vector3d twice_sine_of(const Eigen::Matrix3d& rotation) {
  return {rotation(2, 1) - rotation(1, 2),
          rotation(0, 2) - rotation(2, 0),
          rotation(1, 0) - rotation(0, 1)};
}

/// The axis of some turns, by least squares. A turn of half a circle says nothing of its sense.
Turntable axis_of(const std::vector<Turn>& turns) {
  Turntable table;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Turn& turn : turns)
    sum += std::sin(turn.angle_rad) * twice_sine_of(turn.motion.linear());
  table.axis = sum.normalized();
  // A point c of the axis stays where it is: (1 - R) c = t. Along the axis, it is the nearest one.
  Eigen::Matrix3d squares = table.axis * table.axis.transpose();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  for (const Turn& turn : turns) {
    const Eigen::Matrix3d fixed = Eigen::Matrix3d::Identity() - turn.motion.linear();
    squares += fixed.transpose() * fixed;
    products += fixed.transpose() * turn.motion.translation();
  }
  table.point_mm = squares.ldlt().solve(products);
  return table;
}

/// Whether a part that turned about an axis moved so.
bool follows(const Turntable& table, const Turn& turn) {
  constexpr double kTurn_rad = rad_from_deg(2.0);
  constexpr double kWay = 0.02;  // of the distance
  const Eigen::Matrix3d by(Eigen::AngleAxisd(turn.angle_rad, table.axis));
  const Eigen::AngleAxisd off(turn.motion.linear() * by.transpose());
  const double way_mm = (turn.motion * table.point_mm - table.point_mm).norm();
  return off.angle() < kTurn_rad && way_mm < kWay * table.point_mm.norm();
}

}  // namespace

TurntableOfPoses turntable_of_poses(std::span<const Eigen::Isometry3d> rig_from_object,
                                    std::span<const double> angles_rad) {
  constexpr double kLeastSine = 0.2;  // of a turn that states an axis
  require(rig_from_object.size() == angles_rad.size(),
          "turntable_of_poses: give one angle for each pose");
  const auto turn_between = [&](std::size_t from, std::size_t to) {
    return Turn{rig_from_object[to] * rig_from_object[from].inverse(),
                angles_rad[to] - angles_rad[from]};
  };
  TurntableOfPoses best;
  for (std::size_t from = 0; from < angles_rad.size(); ++from) {
    for (std::size_t to = from + 1; to < angles_rad.size(); ++to) {
      const Turn stated = turn_between(from, to);
      if (std::abs(std::sin(stated.angle_rad)) < kLeastSine) continue;
      const Turntable table = axis_of({stated});
      std::vector<std::size_t> views;
      for (std::size_t view = 0; view < angles_rad.size(); ++view)
        if (view == from || follows(table, turn_between(from, view))) views.push_back(view);
      if (views.size() > best.views.size()) best = {table, std::move(views)};
    }
  }
  if (best.views.size() < 3) return {};
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < best.views.size(); ++i)
    for (std::size_t j = i + 1; j < best.views.size(); ++j)
      turns.push_back(turn_between(best.views[i], best.views[j]));
  best.table = axis_of(turns);
  return best;
}

}  // namespace frangia
