#include "frangia/registration/internal/known_length.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/registration/internal/find_ball_pair.h"

namespace frangia {

KnownLength measure_known_length(const DriftBundle& bundle, const RefineRigOptions& options) {
  constexpr std::size_t kPoints = 40'000;  // of all views
  std::size_t surfels = 0;
  for (const DriftView& view : bundle.views)
    surfels += view.map.surfels.pixels().size();
  const std::size_t every = surfels / kPoints + 1;
  std::vector<OrientedPoint> points;
  std::vector<Eigen::Matrix3Xd> derivatives;  // of the points, object frame
  for (const DriftView& view : bundle.views) {
    const Eigen::Isometry3d object_from_rig =
        bundle.state.table.table.rig_from_object(bundle.state.table.angles_rad[view.station])
            .inverse();
    const auto own = view.map.surfels.pixels();
    for (std::size_t i = 0; i < own.size(); i += every) {
      if (!(own[i].sigma_mm > 0.0F)) continue;
      points.push_back({object_from_rig * own[i].point_mm.cast<double>(),
                        object_from_rig.linear() * own[i].normal.cast<double>()});
      derivatives.emplace_back(object_from_rig.linear() * view.derivatives[i].cast<double>());
    }
  }
  const auto pair = find_ball_pair(points);
  if (!pair) {
    throw Error(ErrorKind::Input,
                "the scan holds no two balls of one size, of which `length` could be the distance; "
                "scan a ball bar, or leave the length out");
  }
  KnownLength found;
  found.scale = *options.ball_distance_mm / pair->distance_mm();
  if (std::abs(found.scale - 1.0) > options.max_scale_error) {
    throw Error(
        ErrorKind::Input,
        fmt::format("the centers of the two balls are {:.3f} mm apart, but `length` is {:g} "
                    "mm; give the distance of their centers",
                    pair->distance_mm(),
                    *options.ball_distance_mm));
  }
  const auto mean_of = [&](const BarBall& ball) {
    Eigen::Matrix3Xd mean = Eigen::Matrix3Xd::Zero(3, bundle.state.w.size());
    for (const std::size_t i : ball.points)
      mean += derivatives[i] / static_cast<double>(ball.points.size());
    return mean;
  };
  const Eigen::Vector3d along =
      (pair->second.sphere.center_mm - pair->first.sphere.center_mm).normalized();
  const Eigen::VectorXd by_w = (mean_of(pair->second) - mean_of(pair->first)).transpose() * along;
  const double sigma_mm = options.relative_length_sigma * *options.ball_distance_mm;
  found.information = by_w * by_w.transpose() / (sigma_mm * sigma_mm);
  return found;
}

void scale_rig(Rig& rig, double factor) {
  rig.projector.position_mm *= factor;
  for (PosedCamera& camera : rig.cameras)
    camera.position_mm *= factor;
  if (rig.turntable) rig.turntable->point_mm *= factor;
  if (rig.laser_sheet) rig.laser_sheet->offset_mm *= factor;
}

}  // namespace frangia
