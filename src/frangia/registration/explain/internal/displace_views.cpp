#include "frangia/registration/explain/internal/displace_views.h"

#include <cmath>

#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"

namespace frangia {

RigChanges rig_changes(const DriftModel& model,
                       const Pattern& pattern,
                       const Eigen::MatrixXd& basis,
                       const Eigen::VectorXd& at) {
  // The derivatives hardly change within a drift: those of its mean serve all views.
  const Eigen::VectorXd mean = changes_of_views(at, basis).rowwise().mean();
  return {PointDrift(model, mean), pattern, basis, model.count()};
}

std::vector<Rig> rigs_of_views(const DriftModel& model,
                               const Eigen::MatrixXd& basis,
                               const Eigen::VectorXd& at) {
  std::vector<Rig> rigs;
  const Eigen::MatrixXd changes = changes_of_views(at, basis);
  for (Eigen::Index view = 0; view < changes.cols(); ++view)
    rigs.push_back(model.rig_at(changes.col(view)));
  return rigs;
}

void displace_views(std::vector<SurfelMap>& maps,
                    const Rig& stated,
                    const std::vector<Rig>& rigs,
                    const Pattern& pattern) {
  for (std::size_t view = 0; view < maps.size(); ++view) {
    const Rig& rig = rigs[view];
    const auto surfels = maps[view].surfels.pixels();
    parallel_chunks(surfels.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        SurfelMap::Surfel& surfel = surfels[i];
        if (!(surfel.sigma_mm > 0.0F)) continue;
        const Eigen::Vector3d point = surfel.point_mm.cast<double>();
        const Eigen::Vector2d pixel = stated.reference().model.project(point);
        const Eigen::Vector2d ray = rig.reference().model.ray(pixel);
        const double phase_rad = phase_at(point, pattern, stated.projector);
        const RayDepth found = intersect_fringe(ray, phase_rad, pattern, rig.projector);
        if (std::isnan(found.depth_mm)) {
          surfel = {};
        } else {
          surfel.point_mm = (found.depth_mm * ray.homogeneous()).cast<float>();
        }
      }
    });
  }
}

}  // namespace frangia
