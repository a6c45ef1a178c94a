#include "frangia/calibrate/internal/rig_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <ceres/ceres.h>

#include "frangia/calibrate/internal/rig_residuals.h"
#include "frangia/calibrate/internal/solve_quietly.h"

namespace frangia {
namespace {

constexpr double kHuber = 3.0;  // standard deviations

void fix(ceres::Problem& problem, double* block, int size, const RigFreedom& freedom, int first) {
  std::vector<int> constant;
  for (int i = 0; i < size; ++i) {
    if (!freedom.free[static_cast<std::size_t>(first) + static_cast<std::size_t>(i)]) {
      constant.push_back(i);
    }
  }
  if (constant.size() == static_cast<std::size_t>(size)) {
    problem.SetParameterBlockConstant(block);
  } else if (!constant.empty()) {
    problem.SetManifold(block, new ceres::SubsetManifold(size, constant));  // NOLINT owned
  }
}

/// The residual of an observation and the blocks of parameters on which it depends.
struct RigCost {
  ceres::CostFunction* function = nullptr;
  std::vector<double*> blocks;
};

RigCost cost_of_observation(const RigObservation& seen,
                            const Eigen::Vector2d& weight,
                            RigParameters& parameters) {
  double* pose = parameters.camera_from_board[seen.view].data();
  double* shape = parameters.board.data();
  double* reference = parameters.cameras.front().intrinsics.data();
  double* projector = parameters.projector.data();
  double* projector_pose = parameters.projector_from_camera.data();
  const CameraResidual by_camera{seen.site, seen.circle_radius_mm, seen.pixel, weight};
  const ProjectorResidual by_projector{seen.site, seen.pixel, weight, seen.reading};
  const LabelResidual by_label{seen.site, seen.pixel, weight, seen.reference, seen.reading};
  constexpr int kI = kIntrinsics;
  if (seen.camera == 0 && !seen.by_projector)
    return {cost_function(by_camera, 2, std::array{kI, kShape, kPose}), {reference, shape, pose}};
  if (seen.camera == 0) {
    return {cost_function(by_projector, 2, std::array{kI, kI, kPose, kShape, kPose}),
            {reference, projector, projector_pose, shape, pose}};
  }
  double* camera = parameters.cameras[seen.camera].intrinsics.data();
  double* camera_pose = parameters.cameras[seen.camera].from_reference.data();
  if (!seen.by_projector)
    return {cost_function(by_camera, 2, std::array{kI, kPose, kShape, kPose}),
            {camera, camera_pose, shape, pose}};
  if (seen.is_label) {
    return {cost_function(by_label, 2, std::array{kI, kI, kPose, kShape, kPose}),
            {reference, camera, camera_pose, shape, pose}};
  }
  return {cost_function(by_projector, 2, std::array{kI, kPose, kI, kPose, kShape, kPose}),
          {camera, camera_pose, projector, projector_pose, shape, pose}};
}

void build(std::span<const RigObservation> observations,
           const RigLayout& layout,
           const RigNoise& noise,
           RigParameters& parameters,
           ceres::Problem& problem) {
  for (const auto& [block, size] : blocks_of(layout, parameters))
    problem.AddParameterBlock(block, size);
  for (RigParameters::Pose& pose : parameters.camera_from_board)
    problem.AddParameterBlock(pose.data(), kPose);
  for (const RigObservation& observation : observations) {
    const Eigen::Vector2d weight = (observation.scale(noise) * observation.sigma_px).cwiseInverse();
    const RigCost cost = cost_of_observation(observation, weight, parameters);
    auto* loss = new ceres::HuberLoss(kHuber);  // NOLINT(*-owning-memory) the problem owns it
    problem.AddResidualBlock(cost.function, loss, cost.blocks);
  }
}

}  // namespace

Eigen::Vector2d independent_residual_of(const RigObservation& observation,
                                        const RigParameters& parameters) {
  Eigen::Vector2d residual = Eigen::Vector2d::Constant(std::nan(""));
  const double* pose = parameters.camera_from_board[observation.view].data();
  const double* shape = parameters.board.data();
  const Eigen::Vector2d one = Eigen::Vector2d::Ones();
  const RigParameters::PosedIntrinsics& seen = parameters.cameras[observation.camera];
  const double* camera = seen.intrinsics.data();
  const double* from_reference = observation.camera > 0 ? seen.from_reference.data() : nullptr;
  if (observation.is_label) {
    LabelResidual{
        observation.site, observation.pixel, one, observation.reference, observation.reading}(
        parameters.cameras.front().intrinsics.data(),
        camera,
        from_reference,
        shape,
        pose,
        residual.data());
  } else if (observation.by_projector) {
    ProjectorResidual{observation.site, observation.pixel, one, observation.reading}.evaluate(
        camera,
        from_reference,
        parameters.projector.data(),
        parameters.projector_from_camera.data(),
        shape,
        pose,
        residual.data());
  } else {
    CameraResidual{observation.site, observation.circle_radius_mm, observation.pixel, one}.evaluate(
        camera, from_reference, shape, pose, residual.data());
  }
  return residual;
}

Eigen::Vector2d residual_of(const RigObservation& observation, const RigParameters& parameters) {
  RigObservation alone = observation;
  if (!observation.is_label) alone.reading.projector_by_camera.setZero();
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
  build(observations, freedom.layout, noise, parameters, problem);
  int first = 0;
  for (const auto& [block, size] : blocks_of(freedom.layout, parameters)) {
    fix(problem, block, size, freedom, first);
    first += size;
  }
  StopCallback stop(run);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;  // eliminates the poses
  options.max_num_iterations = max_iterations;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.num_threads = 1;  // the same bytes on any machine
  options.callbacks.push_back(&stop);
  const ceres::Solver::Summary summary = solve_quietly(std::move(options), problem);
  run.check();
  return {static_cast<int>(summary.iterations.size()), summary.IsSolutionUsable()};
}

RigLinearization linearize_rig(std::span<const RigObservation> observations,
                               const RigLayout& layout,
                               const RigNoise& noise,
                               const RigParameters& parameters) {
  RigParameters copy = parameters;
  ceres::Problem problem;
  build(observations, layout, noise, copy, problem);
  ceres::Problem::EvaluateOptions options;
  for (const auto& [block, size] : blocks_of(layout, copy))
    options.parameter_blocks.push_back(block);
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

std::vector<Eigen::Index> free_columns(const RigFreedom& freedom, Eigen::Index columns) {
  std::vector<Eigen::Index> out;
  for (Eigen::Index i = 0; i < columns; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (at >= freedom.free.size() || freedom.free[at]) out.push_back(i);
  }
  return out;
}

namespace {

bool is_lit(const BoardPoint& point) {
  return point.projector_px.allFinite() && (point.projector_sigma_px.array() > 0.0).all();
}

PhaseReading reading_of(const BoardPoint& point) {
  return {point.camera_px, point.projector_by_camera};
}

/// The point of the reference camera that a further camera sees, too; null if there is none.
const BoardPoint* same_point(std::span<const BoardPoint> points, int index) {
  const auto found = std::find_if(
      points.begin(), points.end(), [&](const BoardPoint& one) { return one.index == index; });
  return found == points.end() ? nullptr : &*found;
}

/// The observation of the projector by one point, if there is one.
void add_phase(const BoardView& view,
               const BoardPoint& point,
               bool has_projector,
               RigObservation observation,
               std::vector<RigObservation>& observations) {
  if (!is_lit(point)) return;
  observation.by_projector = true;
  observation.pixel = point.projector_px;
  observation.sigma_px = point.projector_sigma_px;
  observation.reading = reading_of(point);
  if (!has_projector) {
    if (observation.camera == 0) return;
    const BoardPoint* reference = same_point(view.points, point.index);
    if (reference == nullptr || !is_lit(*reference)) return;
    observation.is_label = true;
    observation.pixel -= reference->projector_px;
    observation.sigma_px =
        (observation.sigma_px.cwiseAbs2() + reference->projector_sigma_px.cwiseAbs2()).cwiseSqrt();
    observation.reference = reading_of(*reference);
  }
  observations.push_back(observation);
}

}  // namespace

std::vector<RigObservation> observations_of(const Board& board,
                                            std::span<const BoardView> views,
                                            bool has_projector) {
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(board);
  const Eigen::Vector2d center = 0.5 * (nominal.front() + nominal.back());
  const Eigen::Vector2d half = nominal.back() - center;
  std::vector<RigObservation> observations;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t camera = 0; camera <= views[view].more.size(); ++camera) {
      const std::vector<BoardPoint>& points = points_of(views[view], camera);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d place = nominal[static_cast<std::size_t>(points[i].index)] - center;
        const Eigen::Vector2d relative = place.cwiseQuotient(half);
        RigObservation seen{
            view, i, {place, board_height_terms(relative.x(), relative.y())}, camera};
        seen.pixel = points[i].camera_px;
        seen.circle_radius_mm = 0.5 * circle_diameter_mm(board);
        observations.push_back(seen);
        add_phase(views[view], points[i], has_projector, seen, observations);
      }
    }
  }
  return observations;
}

}  // namespace frangia
