#include "frangia/calibrate/solve_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "frangia/calibrate/internal/leave_one_out.h"
#include "frangia/calibrate/internal/point_sigma.h"
#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/internal/rig_covariance.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/internal/select_terms.h"
#include "frangia/calibrate/internal/start_values.h"

namespace frangia {
namespace {

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

/// `noise` is the present scale of the standard deviations, from which the robust loss is counted.
SumOfSquares sum_squares(std::span<const RigObservation> observations,
                         const RigParameters& parameters,
                         bool by_projector,
                         double noise) {
  SumOfSquares sum;
  for (const RigObservation& observation : observations) {
    if (observation.by_projector != by_projector) continue;
    const double squared = independent_residual_of(observation, parameters)
                               .cwiseQuotient(observation.sigma_px)
                               .squaredNorm();
    sum.weighted += robust_weight(std::sqrt(squared) / noise) * squared;
    sum.count += 2.0;
  }
  return sum;
}

/// Scales the observations' standard deviations to what is left over, for camera and projector
/// each.
RigNoise noise_of(const SumOfSquares& camera, const SumOfSquares& projector, double parameters) {
  // Each set bears its share of the parameters.
  const double free = 1.0 - parameters / (camera.count + projector.count);
  const double left = std::max(free, 0.05);
  return {std::sqrt(camera.weighted / (camera.count * left)),
          projector.count > 0.0 ? std::sqrt(projector.weighted / (projector.count * left)) : 1.0};
}

/// Adjusts from the parameters of `fit`, with the weights refined to the residuals.
void adjust(std::span<const RigObservation> observations,
            const RigSolveOptions& options,
            Fit& fit,
            const Run& run) {
  constexpr int kRounds = 3;         // the weights converge within these
  constexpr double kSettled = 0.01;  // change of the weights that the result does not feel
  const double parameters = static_cast<double>(fit.freedom.count()) +
                            6.0 * static_cast<double>(fit.parameters.camera_from_board.size());
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
    for (int k = 0; k < kRounds; ++k) {
      fit.noise = noise_of(sum_squares(observations, fit.parameters, false, fit.noise.camera),
                           sum_squares(observations, fit.parameters, true, fit.noise.projector),
                           parameters);
    }
    if (std::abs(fit.noise.camera / before.camera - 1.0) < kSettled &&
        std::abs(fit.noise.projector / before.projector - 1.0) < kSettled)
      break;
  }
}

/// Adds terms one at a time, the most supported first, as long as one is supported.
std::vector<std::string> select_terms(std::span<const RigObservation> observations,
                                      const RigSolveOptions& options,
                                      Fit& fit,
                                      const Run& run) {
  const std::vector<ModelTerm> terms = optional_terms(options.release_board);
  std::vector<std::string> chosen;
  while (const auto term = best_term(
             observations, terms, fit.freedom, fit.noise, fit.parameters, options.min_gain)) {
    set_free(terms[*term], fit.freedom);
    adjust(observations, options, fit, run);
    chosen.push_back(terms[*term].name);
  }
  return chosen;
}

CameraModel model_of(const RigParameters::Intrinsics& from, int width_px, int height_px) {
  CameraModel model;
  model.width_px = width_px;
  model.height_px = height_px;
  model.focal_px = {from[0], from[0] * from[1]};
  model.principal_point_px = {from[2], from[3]};
  model.distortion = {from[4], from[5], from[6], from[7], from[8]};
  return model;
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

void summarize(std::span<const RigObservation> observations,
               std::span<const BoardView> views,
               const RigParameters& parameters,
               RigSolution& out) {
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::nan(""));
  for (const BoardView& view : views) {
    out.camera_residuals_px.emplace_back(view.points.size(), none);
    out.projector_residuals_px.emplace_back(view.points.size(), none);
  }
  out.camera_by_view.resize(views.size());
  out.projector_by_view.resize(views.size());
  for (const RigObservation& observation : observations) {
    const Eigen::Vector2d residual = -residual_of(observation, parameters);
    const bool projector = observation.by_projector;
    (projector ? out.projector_residuals_px
               : out.camera_residuals_px)[observation.view][observation.point] = residual;
    add_residual(residual, projector ? out.projector_residuals : out.camera_residuals);
    add_residual(residual,
                 (projector ? out.projector_by_view : out.camera_by_view)[observation.view]);
  }
  finish(out.camera_residuals);
  finish(out.projector_residuals);
  for (ResidualSummary& summary : out.camera_by_view)
    finish(summary);
  for (ResidualSummary& summary : out.projector_by_view)
    finish(summary);
}

}  // namespace

RigSolution solve_rig(const Board& board,
                      std::span<const BoardView> views,
                      const Rig& known,
                      const RigSolveOptions& options,
                      const Run& run) {
  constexpr std::size_t kFewestViews = 3;
  check_board(board);
  const auto* projector = std::get_if<PinholeModel>(&known.projector.model);
  require(projector != nullptr,
          "projector.model is \"angular\", but a board calibrates a digital projector only");
  if (views.size() < kFewestViews) {
    throw Error(ErrorKind::Input,
                fmt::format("the board is found in {} of at least {} poses; capture more, each "
                            "tilted another way",
                            views.size(),
                            kFewestViews));
  }
  const std::vector<RigObservation> observations = observations_of(board, views);
  const bool projected = std::any_of(
      observations.begin(), observations.end(), [](const auto& one) { return one.by_projector; });
  require(projected, "no point of the board has a phase in both fringe directions; capture both");

  Fit fit;
  fit.parameters = start_values(board, views, known.camera.model, *projector);
  adjust(observations, options, fit, run);
  RigSolution out;
  out.terms = select_terms(observations, options, fit, run);

  for (const ModelTerm& term : optional_terms(options.release_board))
    if (!is_free(term, fit.freedom)) out.held.push_back(term.name);
  out.camera =
      model_of(fit.parameters.camera, known.camera.model.width_px, known.camera.model.height_px);
  out.projector = model_of(fit.parameters.projector, projector->width_px, projector->height_px);
  out.projector_from_camera = isometry_of(fit.parameters.projector_from_camera);
  for (const RigParameters::Pose& pose : fit.parameters.camera_from_board)
    out.camera_from_board.push_back(isometry_of(pose));
  out.board.aspect = fit.parameters.board[0];
  out.board.shear = fit.parameters.board[1];
  std::copy(
      fit.parameters.board.begin() + 2, fit.parameters.board.end(), out.board.height_mm.begin());
  summarize(observations, views, fit.parameters, out);
  out.camera_residuals.sigma_px = fit.noise.camera;
  out.projector_residuals.sigma_px = fit.noise.projector;
  out.iterations = fit.iterations;
  add_covariance(observations, fit.freedom, fit.noise, fit.parameters, out);
  if (out.undetermined.empty()) {
    const ShapeResponse shape = shape_response(board, fit.parameters, out);
    add_point_sigma(shape, out);
    add_leave_one_out(
        observations, fit.freedom, fit.noise, fit.parameters, shape.by_parameter, out);
  }
  return out;
}

}  // namespace frangia
