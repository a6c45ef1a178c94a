#include "frangia/calibrate/internal/rig_bundle.h"

#include <cmath>
#include <memory>

#include <ceres/ceres.h>

#include "frangia/calibrate/internal/rig_residuals.h"

namespace frangia {
namespace {

constexpr double kHuber = 3.0;  // standard deviations

template <std::size_t n>
void fix(ceres::Problem& problem, double* block, const std::array<bool, n>& free) {
  std::vector<int> constant;
  for (std::size_t i = 0; i < n; ++i)
    if (!free[i]) constant.push_back(static_cast<int>(i));
  if (constant.size() == n) {
    problem.SetParameterBlockConstant(block);
  } else if (!constant.empty()) {
    problem.SetManifold(block,
                        new ceres::SubsetManifold(static_cast<int>(n), constant));  // NOLINT owned
  }
}

/// Lets a stop request end the solver.
class StopCallback final : public ceres::IterationCallback {
 public:
  explicit StopCallback(const Run& run) : run_(run) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    return run_.stop.stop_requested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const Run& run_;
};

void build(std::span<const RigObservation> observations,
           const RigFreedom& freedom,
           const RigNoise& noise,
           RigParameters& parameters,
           ceres::Problem& problem) {
  problem.AddParameterBlock(parameters.camera.data(), kIntrinsics);
  problem.AddParameterBlock(parameters.projector.data(), kIntrinsics);
  problem.AddParameterBlock(parameters.projector_from_camera.data(), kPose);
  problem.AddParameterBlock(parameters.board.data(), kShape);
  for (RigParameters::Pose& pose : parameters.camera_from_board)
    problem.AddParameterBlock(pose.data(), kPose);
  for (const RigObservation& observation : observations) {
    const double scale = observation.by_projector ? noise.projector : noise.camera;
    const Eigen::Vector2d weight = (scale * observation.sigma_px).cwiseInverse();
    auto* loss = new ceres::HuberLoss(kHuber);  // NOLINT(*-owning-memory) the problem owns it
    double* pose = parameters.camera_from_board[observation.view].data();
    if (observation.by_projector) {
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ProjectorResidual,
                                                               2,
                                                               kIntrinsics,
                                                               kIntrinsics,
                                                               kPose,
                                                               kShape,
                                                               kPose>(
                                   new ProjectorResidual{observation.site,
                                                         observation.pixel,
                                                         weight,
                                                         observation.camera_px,
                                                         observation.projector_by_camera}),
                               loss,
                               parameters.camera.data(),
                               parameters.projector.data(),
                               parameters.projector_from_camera.data(),
                               parameters.board.data(),
                               pose);
    } else {
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<CameraResidual, 2, kIntrinsics, kShape, kPose>(
              new CameraResidual{
                  observation.site, observation.circle_radius_mm, observation.pixel, weight}),
          loss,
          parameters.camera.data(),
          parameters.board.data(),
          pose);
    }
  }
  fix(problem, parameters.camera.data(), freedom.camera);
  fix(problem, parameters.projector.data(), freedom.projector);
  fix(problem, parameters.board.data(), freedom.board);
}

}  // namespace

std::size_t RigFreedom::count() const {
  std::size_t free = kPose;
  for (const bool flag : camera)
    free += flag ? 1 : 0;
  for (const bool flag : projector)
    free += flag ? 1 : 0;
  for (const bool flag : board)
    free += flag ? 1 : 0;
  return free;
}

std::vector<RigObservation> observations_of(const Board& board, std::span<const BoardView> views) {
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(board);
  const Eigen::Vector2d center = 0.5 * (nominal.front() + nominal.back());
  const Eigen::Vector2d half = nominal.back() - center;
  std::vector<RigObservation> observations;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t i = 0; i < views[view].points.size(); ++i) {
      const BoardPoint& point = views[view].points[i];
      const Eigen::Vector2d place = nominal[static_cast<std::size_t>(point.index)] - center;
      const Eigen::Vector2d relative = place.cwiseQuotient(half);
      const BoardSite site{place, board_height_terms(relative.x(), relative.y())};
      RigObservation seen{view, i, site};
      seen.pixel = point.camera_px;
      seen.sigma_px.setOnes();
      seen.circle_radius_mm = 0.5 * circle_diameter_mm(board);
      observations.push_back(seen);
      if (!point.projector_px.allFinite() || !(point.projector_sigma_px.array() > 0.0).all())
        continue;
      RigObservation lit{view, i, site, true};
      lit.pixel = point.projector_px;
      lit.sigma_px = point.projector_sigma_px;
      lit.camera_px = point.camera_px;
      lit.projector_by_camera = point.projector_by_camera;
      observations.push_back(lit);
    }
  }
  return observations;
}

Eigen::Vector2d independent_residual_of(const RigObservation& observation,
                                        const RigParameters& parameters) {
  Eigen::Vector2d residual = Eigen::Vector2d::Constant(std::nan(""));
  const double* pose = parameters.camera_from_board[observation.view].data();
  const Eigen::Vector2d one = Eigen::Vector2d::Ones();
  if (observation.by_projector) {
    ProjectorResidual{observation.site,
                      observation.pixel,
                      one,
                      observation.camera_px,
                      observation.projector_by_camera}(parameters.camera.data(),
                                                       parameters.projector.data(),
                                                       parameters.projector_from_camera.data(),
                                                       parameters.board.data(),
                                                       pose,
                                                       residual.data());
  } else {
    CameraResidual{observation.site, observation.circle_radius_mm, observation.pixel, one}(
        parameters.camera.data(), parameters.board.data(), pose, residual.data());
  }
  return residual;
}

Eigen::Vector2d residual_of(const RigObservation& observation, const RigParameters& parameters) {
  RigObservation alone = observation;
  alone.projector_by_camera.setZero();
  return independent_residual_of(alone, parameters);
}

double robust_weight(double sigmas) {
  return sigmas > kHuber ? kHuber / sigmas : 1.0;
}

RigBundleResult adjust_rig(std::span<const RigObservation> observations,
                           const RigFreedom& freedom,
                           const RigNoise& noise,
                           int max_iterations,
                           RigParameters& parameters,
                           const Run& run) {
  ceres::Problem problem;
  build(observations, freedom, noise, parameters, problem);
  StopCallback stop(run);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;  // eliminates the poses
  options.max_num_iterations = max_iterations;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.num_threads = 1;  // the same bytes on any machine
  options.logging_type = ceres::SILENT;
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  run.check();
  return {static_cast<int>(summary.iterations.size()), summary.IsSolutionUsable()};
}

RigLinearization linearize_rig(std::span<const RigObservation> observations,
                               const RigFreedom& freedom,
                               const RigNoise& noise,
                               const RigParameters& parameters) {
  RigParameters copy = parameters;
  ceres::Problem problem;
  build(observations, freedom, noise, copy, problem);
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {copy.camera.data(),
                              copy.projector.data(),
                              copy.projector_from_camera.data(),
                              copy.board.data()};
  for (RigParameters::Pose& pose : copy.camera_from_board)
    options.parameter_blocks.push_back(pose.data());
  ceres::CRSMatrix sparse;
  std::vector<double> residuals;
  problem.Evaluate(options, nullptr, &residuals, nullptr, &sparse);
  RigLinearization out;
  out.residuals =
      Eigen::VectorXd::Map(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
  out.jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    const auto end = static_cast<std::size_t>(sparse.rows[static_cast<std::size_t>(row) + 1]);
    for (auto i = static_cast<std::size_t>(sparse.rows[static_cast<std::size_t>(row)]); i < end;
         ++i)
      out.jacobian(row, sparse.cols[i]) = sparse.values[i];
  }
  return out;
}

}  // namespace frangia
