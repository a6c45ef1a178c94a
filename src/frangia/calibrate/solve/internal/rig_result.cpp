#include "frangia/calibrate/solve/internal/rig_result.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "frangia/calibrate/internal/rig_observations.h"

namespace frangia {
namespace {

CameraModel model_of(const RigParameters::Intrinsics& from, const CameraModel& size) {
  CameraModel model;
  model.width_px = size.width_px;
  model.height_px = size.height_px;
  model.focal_px = {from[0], from[0] * from[1]};
  model.principal_point_px = {from[2], from[3]};
  model.distortion = {from[4], from[5], from[6], from[7], from[8]};
  return model;
}

/// Where the residuals of one device go; no list of points is kept for the projector pixels that a
/// further camera reads.
struct ResidualSink {
  ResidualSummary* all = nullptr;
  std::vector<ResidualSummary>* by_view = nullptr;
  std::vector<std::vector<Eigen::Vector2d>>* points = nullptr;
};

ResidualSink sink_of(SolvedCamera& camera, bool is_reference, bool by_projector) {
  if (!by_projector) return {&camera.residuals, &camera.by_view, &camera.residuals_px};
  return {&camera.projector_residuals,
          &camera.projector_by_view,
          is_reference ? &camera.projector_residuals_px : nullptr};
}

void add_residual(const Eigen::Vector2d& residual, ResidualSummary& summary) {
  summary.rms_px += residual.squaredNorm();
  summary.max_px = std::max(summary.max_px, residual.norm());
  ++summary.points;
}

void finish(ResidualSummary& summary) {
  if (summary.points > 0)
    summary.rms_px = std::sqrt(summary.rms_px / static_cast<double>(summary.points));
}

}  // namespace

RigSolution solution_of(const Rig& known, const RigParameters& parameters) {
  RigSolution solution;
  solution.has_projector = !known.projector.is_label;
  const auto& projector = std::get<PinholeModel>(known.projector.model);
  if (solution.has_projector) {
    solution.projector = model_of(parameters.projector, projector);
    solution.projector_from_camera = isometry_of(parameters.projector_from_camera);
  } else {
    solution.projector = projector;
  }
  solution.cameras.resize(parameters.cameras.size());
  for (std::size_t i = 0; i < solution.cameras.size(); ++i) {
    const Camera& camera = known.cameras[i].camera;
    solution.cameras[i].name = camera.name;
    solution.cameras[i].model = model_of(parameters.cameras[i].intrinsics, camera.model);
    solution.cameras[i].camera_from_rig = isometry_of(parameters.cameras[i].from_reference);
  }
  for (const RigParameters::Pose& pose : parameters.camera_from_board)
    solution.camera_from_board.push_back(isometry_of(pose));
  solution.board.aspect = parameters.board[0];
  solution.board.shear = parameters.board[1];
  std::copy(parameters.board.begin() + 2, parameters.board.end(), solution.board.height_mm.begin());
  return solution;
}

std::vector<SolvedCamera> with_residuals(std::vector<SolvedCamera> cameras,
                                         std::span<const RigObservation> observations,
                                         std::span<const BoardView> views,
                                         const RigParameters& parameters,
                                         const RigNoise& noise) {
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::nan(""));
  std::vector<ResidualSink> sinks;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    for (const bool by_projector : {false, true}) {
      const ResidualSink& sink =
          sinks.emplace_back(sink_of(cameras[camera], camera == 0, by_projector));
      sink.by_view->resize(views.size());
      sink.all->sigma_px = (by_projector ? noise.projector : noise.camera)[camera];
      if (sink.points == nullptr) continue;
      for (const BoardView& view : views)
        sink.points->emplace_back(camera <= view.more.size() ? points_of(view, camera).size() : 0,
                                  none);
    }
  }
  for (const RigObservation& observation : observations) {
    const Eigen::Vector2d residual = -residual_of(observation, parameters);
    const ResidualSink& sink = sinks[2 * observation.camera + (observation.by_projector ? 1 : 0)];
    if (sink.points != nullptr) (*sink.points)[observation.view][observation.point] = residual;
    add_residual(residual, *sink.all);
    add_residual(residual, (*sink.by_view)[observation.view]);
  }
  for (const ResidualSink& sink : sinks) {
    finish(*sink.all);
    std::for_each(sink.by_view->begin(), sink.by_view->end(), finish);
  }
  return cameras;
}

}  // namespace frangia
