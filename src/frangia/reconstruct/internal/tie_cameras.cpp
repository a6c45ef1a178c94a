#include "frangia/reconstruct/internal/tie_cameras.h"

#include <cstddef>
#include <utility>

namespace frangia {

void tie_cameras(MeasuredViews& measured, const Rig& rig) {
  for (std::size_t camera = 1; camera < measured.cameras.size(); ++camera) {
    const Eigen::Isometry3d camera_from_rig = rig.cameras[camera].camera_from_rig();
    for (std::size_t i = 0; i < measured.reference().size(); ++i) {
      measured.cameras[camera].set_rig_from_object(
          i, camera_from_rig * measured.reference().rig_from_object(i));
    }
  }
}

void clear_outliers_of_cameras(MeasuredSetup& setup) {
  if (!setup.registration) return;
  for (ViewStore& views : setup.measured.cameras) {
    for (const std::size_t view : setup.registration->outliers)
      views.clear(view);
  }
}

PointCloud collect_points_of_cameras(
    const std::vector<CameraViews>& cameras,
    const Run& run,
    const std::function<void(View&, std::size_t camera)>& add_systematic) {
  PointCloud all;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    std::function<void(View&)> add;
    if (add_systematic) add = [&](View& view) { add_systematic(view, camera); };
    PointCloud points = collect_points(cameras[camera].views, cameras[camera].camera, run, add);
    if (all.points_mm.empty()) {
      all = std::move(points);
      continue;
    }
    const bool systematic = !all.systematic_mm.empty() || !points.systematic_mm.empty();
    if (systematic) all.systematic_mm.resize(all.points_mm.size());
    all.points_mm.insert(all.points_mm.end(), points.points_mm.begin(), points.points_mm.end());
    all.sigma_mm.insert(all.sigma_mm.end(), points.sigma_mm.begin(), points.sigma_mm.end());
    all.systematic_mm.insert(
        all.systematic_mm.end(), points.systematic_mm.begin(), points.systematic_mm.end());
    if (systematic) all.systematic_mm.resize(all.points_mm.size());
  }
  return all;
}

std::vector<CameraViews> views_of_cameras(const MeasuredViews& measured, const Rig& rig) {
  std::vector<CameraViews> all;
  for (std::size_t i = 0; i < measured.cameras.size(); ++i)
    all.push_back({measured.cameras[i], rig.cameras[i].camera.model});
  return all;
}

}  // namespace frangia
