#include "frangia/service/internal/station_cloud.h"

#include <cmath>

#include "frangia/decode/triangulate_view.h"
#include "frangia/range/range_grid.h"

namespace frangia {

PointCloud StationCloud::of(const DecodedView& decoded, double angle_rad) const {
  PointCloud cloud;
  DecodedView view = decoded;
  const ViewFit fit = check_view(view, rig_, rays_, false);
  if (!fit.fits()) return cloud;
  const RangeGrid range = triangulate_view(view, fit, rig_, rays_, DirectionChoice::Fused).range;
  const Eigen::Isometry3d object_from_rig = rig_.rig_from_object(angle_rad).inverse();
  for (int y = 0; y < range.depth_mm.height(); ++y) {
    for (int x = 0; x < range.depth_mm.width(); ++x) {
      const RangePixel pixel = range.pixel(x, y);
      if (std::isnan(pixel.depth_mm)) continue;
      const Eigen::Vector2f& ray = rays_(x, y);
      const Eigen::Vector3d point_mm =
          Eigen::Vector3f(ray.x(), ray.y(), 1.0F).cast<double>() * pixel.depth_mm;
      cloud.points_mm.emplace_back((object_from_rig * point_mm).cast<float>());
      cloud.sigma_mm.push_back(pixel.sigma_mm);
    }
  }
  return cloud;
}

}  // namespace frangia
