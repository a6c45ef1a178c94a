#include "frangia/views/collect_points.h"

#include <cmath>

#include "frangia/core/error.h"

namespace frangia {

PointCloud collect_points(const ViewStore& views,
                          const CameraModel& camera,
                          const Run& run,
                          std::span<const SigmaTerm> terms,
                          std::size_t camera_index) {
  const auto rays = rays_of(camera);
  const bool has_systematic = views.has_systematic() || !terms.empty();
  PointCloud cloud;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.check();
    View view = views.load_points(i, PointSigma::BothParts);
    add_terms(view, camera_index, terms);
    require(same_size(view.range.depth_mm, rays),
            "collect_points: a view and the camera differ in size");
    const Eigen::Isometry3d object_from_rig = view.rig_from_object.inverse();
    for (std::size_t pixel = 0; pixel < rays.pixels().size(); ++pixel) {
      const float depth = view.range.depth_mm.pixels()[pixel];
      if (std::isnan(depth)) continue;
      const Eigen::Vector3f seen = depth * rays.pixels()[pixel].homogeneous();
      cloud.points_mm.emplace_back((object_from_rig * seen.cast<double>()).cast<float>());
      cloud.sigma_mm.push_back(view.range.sigma_mm.pixels()[pixel]);
      if (!has_systematic) continue;
      cloud.systematic_mm.push_back(
          view.range.systematic_mm.empty() ? 0.0F : view.range.systematic_mm.pixels()[pixel]);
    }
  }
  return cloud;
}

}  // namespace frangia
