#include "frangia/calibrate/report/residual_maps.h"

#include <algorithm>
#include <cmath>

#include "frangia/calibrate/internal/assess_solution.h"

namespace frangia {
namespace {

/// Of a camera, 0 being the reference camera, or of the projector as the reference camera reads it.
ResidualMap map_of(const RigCalibration& result, std::size_t camera, bool by_projector) {
  const SolvedCamera& solved = result.solution.cameras[camera];
  const CameraModel& model = by_projector ? result.solution.projector : solved.model;
  const auto& residuals = by_projector ? solved.projector_residuals_px : solved.residuals_px;
  ResidualMap map{
      .title = by_projector ? "Projector" : "Camera",
      .width = model.width_px,
      .height = model.height_px,
      .rms = by_projector ? solved.projector_residuals.rms_px : solved.residuals.rms_px};
  if (camera > 0) map.title = "camera \"" + solved.name + "\"";
  for (std::size_t view = 0; view < result.views.size(); ++view) {
    const std::vector<BoardPoint>& points = points_of(result.views[view], camera);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d& from = by_projector ? points[i].projector_px : points[i].camera_px;
      if (from.allFinite() && residuals[view][i].allFinite())
        map.arrows.push_back({from, residuals[view][i]});
    }
  }
  return map;
}

}  // namespace

std::vector<ResidualMap> residual_maps(const RigCalibration& result) {
  std::vector<ResidualMap> maps{map_of(result, 0, false)};
  if (result.solution.has_projector) maps.push_back(map_of(result, 0, true));
  for (std::size_t camera = 1; camera < result.solution.cameras.size(); ++camera)
    maps.push_back(map_of(result, camera, false));
  return maps;
}

std::vector<PoseResiduals> pose_residuals(const RigCalibration& result) {
  const RigSolution& solution = result.solution;
  std::vector<PoseResiduals> poses(result.views.size());
  const auto mark = [&](const std::vector<ResidualSummary>& by_view) {
    for (const std::size_t i : outlier_views(by_view))
      poses[i].is_outlier = true;
  };
  for (const SolvedCamera& camera : solution.cameras) {
    mark(camera.by_view);
    mark(camera.projector_by_view);
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Isometry3d& pose = solution.camera_from_board[i];
    poses[i].name = result.views[i].name;
    poses[i].camera_rms_px = solution.reference().by_view[i].rms_px;
    if (solution.has_projector)
      poses[i].projector_rms_px = solution.reference().projector_by_view[i].rms_px;
    poses[i].distance_mm = pose.translation().norm();
    poses[i].tilt_rad =
        std::acos(std::min(1.0, std::abs(pose.linear().col(2).dot(Eigen::Vector3d::UnitZ()))));
    if (i < solution.leave_one_out_mm.size()) poses[i].change_mm = solution.leave_one_out_mm[i];
  }
  return poses;
}

}  // namespace frangia
