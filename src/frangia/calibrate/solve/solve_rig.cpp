#include "frangia/calibrate/solve/solve_rig.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "frangia/calibrate/internal/assess_solution.h"
#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/internal/start_values.h"
#include "frangia/calibrate/solve/internal/rig_covariance.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/rig_covariance.h"

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

/// A solution with the models and poses of all devices, the poses of the board and its shape. The
/// sizes are those of the known rig.
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

/// The cameras of a solution with their residuals and the summaries of these.
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

/// How far the triangulated points move when one pose is left out; see `RigSolution`.
struct LeaveOneOut {
  std::vector<double> by_view_mm;
  double spread_mm = 0.0;
};

/// Leaves out each pose in turn.
///
/// @shape    `response` as `shape_response` returns it
/// @source   one Gauss-Newton step from the solution of all poses to that of all but one; the
///           jackknife, Tukey 1958, for the spread
LeaveOneOut leave_one_out(std::span<const RigObservation> observations,
                          const RigFreedom& freedom,
                          const RigNoise& noise,
                          const RigParameters& parameters,
                          const Eigen::MatrixXd& response) {
  LeaveOneOut out;
  RigLinearization all = linearize_rig(observations, freedom.layout, noise, parameters);
  const std::vector<Eigen::Index> columns = free_columns(freedom, all.jacobian.cols());
  all.jacobian = all.jacobian(Eigen::all, columns).eval();
  const Eigen::MatrixXd normal = all.jacobian.transpose() * all.jacobian;
  const Eigen::VectorXd gradient = all.jacobian.transpose() * all.residuals;
  // The free parameters of the devices come first.
  const auto devices = static_cast<Eigen::Index>(freedom.layout.board());
  const auto shown = std::lower_bound(columns.begin(), columns.end(), devices) - columns.begin();
  const Eigen::MatrixXd by_free =
      response(Eigen::all, std::vector<Eigen::Index>(columns.begin(), columns.begin() + shown));
  const std::size_t views = parameters.camera_from_board.size();
  const auto points = static_cast<double>(response.rows()) / 3.0;
  double squares = 0.0;
  for (std::size_t view = 0; view < views; ++view) {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (observations[i].view != view) continue;
      rows.push_back(static_cast<Eigen::Index>(2 * i));
      rows.push_back(static_cast<Eigen::Index>(2 * i + 1));
    }
    const Eigen::MatrixXd jacobian = all.jacobian(rows, Eigen::all);
    Eigen::MatrixXd others = normal - jacobian.transpose() * jacobian;
    // The pose of the view itself is open without the view.
    const auto first = others.rows() - kPose * static_cast<Eigen::Index>(views - view);
    others.middleRows<kPose>(first).setZero();
    others.middleCols<kPose>(first).setZero();
    others.block<kPose, kPose>(first, first).setIdentity();
    Eigen::VectorXd slope = gradient - jacobian.transpose() * all.residuals(rows);
    slope.segment<kPose>(first).setZero();
    const Eigen::VectorXd step = -solve_symmetric(others, slope);
    const double square = (by_free * step.head(shown)).squaredNorm() / points;
    out.by_view_mm.push_back(std::sqrt(square));
    squares += square;
  }
  const auto count = static_cast<double>(views);
  out.spread_mm = std::sqrt((count - 1.0) / count * squares);
  return out;
}

/// One state of the adjustment and how well it fits.
struct Fit {
  RigParameters parameters;
  RigFreedom freedom;
  RigNoise noise;
  int iterations = 0;
};

struct SumOfSquares {
  double weighted = 0.0;  ///< by the observations' own sigma and the robust loss
  double count = 0.0;     ///< of coordinates
};

/// Scales the standard deviations of the observations to what is left over, for each camera and for
/// the projector pixels that it reads. Each set bears its share of the parameters.
RigNoise noise_of(std::span<const RigObservation> observations, const Fit& fit) {
  std::vector<SumOfSquares> by_camera(fit.noise.camera.size());
  std::vector<SumOfSquares> by_projector(fit.noise.camera.size());
  for (const RigObservation& observation : observations) {
    SumOfSquares& sum = (observation.by_projector ? by_projector : by_camera)[observation.camera];
    const double squared = independent_residual_of(observation, fit.parameters)
                               .cwiseQuotient(observation.sigma_px)
                               .squaredNorm();
    // The robust loss is counted from the present scale.
    sum.weighted += robust_weight(std::sqrt(squared) / observation.scale(fit.noise)) * squared;
    sum.count += 2.0;
  }
  const double parameters = static_cast<double>(fit.freedom.count()) +
                            6.0 * static_cast<double>(fit.parameters.camera_from_board.size());
  const double coordinates = 2.0 * static_cast<double>(observations.size());
  const double left = std::max(1.0 - parameters / coordinates, 0.05);
  const auto scale_of = [&](const SumOfSquares& sum) {
    return sum.count > 0.0 ? std::sqrt(sum.weighted / (sum.count * left)) : 1.0;
  };
  RigNoise noise(by_camera.size());
  for (std::size_t i = 0; i < by_camera.size(); ++i) {
    noise.camera[i] = scale_of(by_camera[i]);
    noise.projector[i] = scale_of(by_projector[i]);
  }
  return noise;
}

/// Largest relative change of a scale.
double change_of(const RigNoise& now, const RigNoise& before) {
  double largest = 0.0;
  for (std::size_t i = 0; i < now.camera.size(); ++i) {
    largest = std::max({largest,
                        std::abs(now.camera[i] / before.camera[i] - 1.0),
                        std::abs(now.projector[i] / before.projector[i] - 1.0)});
  }
  return largest;
}

/// Adjusts from the parameters of `fit`, with the weights refined to the residuals.
Fit adjusted(std::span<const RigObservation> observations,
             const RigSolveOptions& options,
             Fit fit,
             const Run& run) {
  constexpr int kRounds = 3;         // the weights converge within these
  constexpr double kSettled = 0.01;  // change of the weights that the result does not feel
  for (int i = 0; i < kRounds; ++i) {
    const RigBundleResult result = adjust_rig(
        observations, fit.freedom, fit.noise, options.max_iterations, fit.parameters, run);
    if (!result.usable) {
      throw Error(
          ErrorKind::Numeric,
          "the calibration does not converge; check the board's corners and square, and the "
          "views for one that is swapped or out of step");
    }
    fit.iterations += result.iterations;
    const RigNoise before = fit.noise;
    for (int k = 0; k < kRounds; ++k)
      fit.noise = noise_of(observations, fit);
    if (change_of(fit.noise, before) < kSettled) break;
  }
  return fit;
}

/// Names of the parameters of all devices, in the order of the layout.
std::vector<std::string> device_parameters(const Rig& known) {
  std::vector<std::string> names = rig_parameter_names(known);
  if (known.projector.is_label)
    std::erase_if(names, [](const std::string& name) { return name.starts_with("projector."); });
  return names;
}

void check_views(std::span<const BoardView> views, const Rig& known) {
  constexpr std::size_t kFewestViews = 3;
  require(!known.projector.is_angular(),
          "projector.model is \"angular\", but a board calibrates a digital projector only");
  require(!known.projector.is_label || known.cameras.size() > 1,
          "projector.model is \"label\", which needs two cameras: add [[more_cameras]], or set "
          "model = \"pinhole\" to calibrate the projector");
  if (views.size() >= kFewestViews) return;
  throw Error(ErrorKind::Input,
              fmt::format("the board is found in {} of at least {} poses; capture more, each "
                          "tilted another way",
                          views.size(),
                          kFewestViews));
}

}  // namespace

RigSolution solve_rig(const Board& board,
                      std::span<const BoardView> views,
                      const Rig& known,
                      const RigSolveOptions& options,
                      const Run& run) {
  check_board(board);
  check_views(views, known);
  const bool has_projector = !known.projector.is_label;
  const std::vector<RigObservation> observations = observations_of(board, views, has_projector);
  const bool projected = std::any_of(
      observations.begin(), observations.end(), [](const auto& one) { return one.by_projector; });
  require(projected, "no point of the board has a phase in both fringe directions; capture both");

  std::vector<std::string> cameras;
  for (std::size_t i = 1; i < known.cameras.size(); ++i)
    cameras.push_back(known.cameras[i].camera.name);
  const RigLayout layout{has_projector, known.cameras.size()};
  Fit fit{start_values(board, views, known), RigFreedom(layout), RigNoise(layout.cameras)};
  fit = adjusted(observations, options, std::move(fit), run);
  // Terms are added one at a time, the most supported first, as long as one is supported.
  const std::vector<ModelTerm> terms = optional_terms(layout, cameras, options.release_board);
  std::vector<std::string> chosen;
  while (const auto term = best_term(
             observations, terms, fit.freedom, fit.noise, fit.parameters, options.min_gain)) {
    set_free(terms[*term], fit.freedom);
    fit = adjusted(observations, options, std::move(fit), run);
    chosen.push_back(terms[*term].name);
  }
  RigSolution out = solution_of(known, fit.parameters);
  out.terms = std::move(chosen);
  for (const ModelTerm& term : terms)
    if (!is_free(term, fit.freedom)) out.held.push_back(term.name);
  out.cameras =
      with_residuals(std::move(out.cameras), observations, views, fit.parameters, fit.noise);
  out.iterations = fit.iterations;
  out.parameters = device_parameters(known);
  SolvedCovariance solved =
      covariance_of(observations, fit.freedom, fit.noise, fit.parameters, out.parameters);
  out.covariance = std::move(solved.covariance);
  out.undetermined = std::move(solved.undetermined);
  if (!out.undetermined.empty()) return out;
  const ShapeResponse shape = shape_response(board, layout, fit.parameters, out);
  out.point_sigma_mm = point_sigma_mm(shape, out.covariance);
  out.distance_mm = shape.distance_mm;
  LeaveOneOut change =
      leave_one_out(observations, fit.freedom, fit.noise, fit.parameters, shape.by_parameter);
  out.leave_one_out_mm = std::move(change.by_view_mm);
  out.spread_mm = change.spread_mm;
  return out;
}

}  // namespace frangia
