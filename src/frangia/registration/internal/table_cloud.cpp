#include "frangia/registration/internal/table_cloud.h"

#include <algorithm>
#include <utility>

#include "frangia/core/median.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/view_pairs.h"
#include "frangia/views/load_each_view.h"

namespace frangia {

TableCloud gather_table_cloud(const ViewStore& views, const CameraModel& camera, const Run& run) {
  const std::size_t surfels = surfels_per_view(20000, views.size());
  const std::size_t map_pixels = 16 * surfels;  // denser than the surfels that are picked
  const CameraRays rays(views, camera);
  const LocalPlanesOptions options{
      .every = surfel_stride(camera.width_px, camera.height_px, map_pixels)};
  TableCloud cloud;
  std::vector<float> sigmas_mm;
  std::vector<float> distances_mm;
  LocalPlanes planes;
  load_each_view(views, [&](std::size_t i, const View& view) {
    run.report(static_cast<double>(i) / static_cast<double>(views.size()));
    planes = local_planes(view, rays, options, std::move(planes));
    const Eigen::Isometry3d object_from_rig = views.rig_from_object(i).inverse();
    for (const auto& surfel : pick_surfels(make_surfel_map(planes, rays, map_pixels), surfels)) {
      cloud.points.emplace_back(object_from_rig * surfel.point_mm.cast<double>());
      cloud.normals.emplace_back(object_from_rig.linear() * surfel.normal.cast<double>());
      sigmas_mm.push_back(surfel.sigma_mm);
      distances_mm.push_back(surfel.point_mm.norm());
    }
  });
  cloud.sigma_mm = static_cast<double>(median(std::move(sigmas_mm)));
  cloud.working_distance_mm = static_cast<double>(median(std::move(distances_mm)));
  return cloud;
}

double reach_above(const std::vector<Eigen::Vector3d>& points, double height_mm) {
  std::vector<double> reach;
  for (const auto& point : points) {
    if (point.z() > height_mm) reach.push_back(point.head<2>().norm());
  }
  if (reach.empty()) return 0.0;
  const auto most = reach.begin() + static_cast<std::ptrdiff_t>(reach.size() * 99 / 100);
  std::nth_element(reach.begin(), most, reach.end());
  return *most;
}

}  // namespace frangia
