#include "frangia/calibrate/artifact/solve_artifacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/calibrate/internal/assess_solution.h"
#include "frangia/calibrate/internal/fit_sheet.h"
#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/internal/start_values.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

constexpr std::array kPriorNames = {
    "focal_px", "focal_ratio", "principal_x_px", "principal_y_px", "k1", "k2", "p1", "p2", "k3"};

/// Place of a parameter of a rig's covariance among the 25 of the prior.
std::optional<Eigen::Index> prior_column(const std::string& name) {
  static constexpr std::array kPoseAndPitch = {"projector.rotation_x_rad",
                                               "projector.rotation_y_rad",
                                               "projector.rotation_z_rad",
                                               "projector.x_mm",
                                               "projector.y_mm",
                                               "projector.z_mm",
                                               "projector.pitch_scale"};
  for (std::size_t i = 0; i < kPriorNames.size(); ++i) {
    if (name == fmt::format("camera.{}", kPriorNames.at(i))) return static_cast<Eigen::Index>(i);
    if (name == fmt::format("projector.{}", kPriorNames.at(i)))
      return static_cast<Eigen::Index>(i) + 9;
  }
  for (std::size_t i = 0; i < kPoseAndPitch.size(); ++i)
    if (name == kPoseAndPitch.at(i)) return static_cast<Eigen::Index>(i) + 18;
  return std::nullopt;
}

/// Takes the covariance of the start as a prior. That of the pose of an angular projector is left
/// out: it is estimated again.
void set_artifact_prior(const Rig& start, ArtifactProblem& problem) {
  if (!start.calibration || start.calibration->covariance.empty()) return;
  const RigCovariance& known = start.calibration->covariance;
  std::vector<Eigen::Index> rows;
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < known.parameters.size(); ++i) {
    const auto column = prior_column(known.parameters[i]);
    const auto row = static_cast<Eigen::Index>(i);
    const bool camera = column && *column < 9;
    if (!column || !(known.covariance(row, row) > 0.0)) continue;
    if (start.projector.is_angular() && !camera) continue;
    rows.push_back(row);
    columns.push_back(*column);
  }
  if (rows.empty()) return;
  const Eigen::MatrixXd covariance = known.covariance(rows, rows);
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const auto eigen =
      symmetric_eigen(Eigen::MatrixXd(scale.asDiagonal() * covariance * scale.asDiagonal()));
  constexpr double kLeast = 1e-9;  // of a correlation matrix that is written with nine digits
  const Eigen::VectorXd root = eigen.values.cwiseMax(kLeast).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd whiten = root.asDiagonal() * eigen.vectors.transpose() * scale.asDiagonal();
  problem.prior = Eigen::MatrixXd::Zero(whiten.rows(), 25);
  for (std::size_t i = 0; i < columns.size(); ++i)
    problem.prior.col(columns[i]) = whiten.col(static_cast<Eigen::Index>(i));
  const auto covers = [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index i = first; i < first + count; ++i)
      if (std::find(columns.begin(), columns.end(), i) == columns.end()) return false;
    return true;
  };
  problem.free_camera = covers(0, 9);
  problem.free_intrinsics = problem.free_camera && covers(9, 15);
  if (!problem.free_camera || (!start.projector.is_angular() && !problem.free_intrinsics)) {
    problem.prior.resize(0, 25);
    problem.free_camera = problem.free_intrinsics = false;
  }
}

/// @errors   Error(Input) as `solve_artifacts`, before anything is solved
void check_artifact_captures(std::span<const ArtifactCapture> captures, const Rig& start) {
  constexpr std::size_t kFewestViews = 3;
  constexpr double kLeast_rad = 0.35;  // 20 degrees
  if (!start.turntable) {
    throw Error(ErrorKind::Input,
                "the rig has no [turntable]; add its point_mm and axis to rig.toml, within a few "
                "degrees");
  }
  require(!captures.empty(), "there is no plate and no ball to calibrate by");
  for (const ArtifactCapture& capture : captures) {
    const std::string name = name_of(capture.artifact);
    require(!std::holds_alternative<Screen>(capture.artifact), "a screen does not turn");
    if (capture.views.size() < kFewestViews) {
      throw Error(ErrorKind::Input,
                  fmt::format("the {} is found in {} of at least {} views; turn the table by "
                              "smaller steps, so that camera and projector see it",
                              name,
                              capture.views.size(),
                              kFewestViews));
    }
    double widest = 0.0;
    for (const ArtifactView& a : capture.views)
      for (const ArtifactView& b : capture.views)
        widest = std::max(widest, std::abs(std::remainder(a.angle_rad - b.angle_rad, kTwoPi)));
    if (widest < kLeast_rad) {
      throw Error(ErrorKind::Input,
                  fmt::format("the angles of the views of the {} span {:.1f} degrees; state "
                              "angle_deg of each view in scan.toml, and turn the table by 60 to "
                              "120 degrees in all",
                              name,
                              deg_from_rad(widest)));
    }
  }
}

/// Covariance of the estimated parameters. Directions that the data leaves open are infinite.
struct ArtifactInverse {
  std::vector<std::string> names;
  Eigen::MatrixXd covariance;
  std::vector<std::string> open;
};

/// Inverts the normal equations; a direction whose eigenvalue is below 1e-13 of the largest, in
/// parameters scaled to unit diagonal, is open.
ArtifactInverse invert_artifacts(const ArtifactLinearization& linear) {
  constexpr double kOpen = 1e-13;
  constexpr double kMuch = 0.1;  // share of a parameter that lies in open directions
  const NormalInverse inverse = invert_normal(linear.normal, kOpen);
  ArtifactInverse out{linear.names, inverse.covariance, {}};
  for (Eigen::Index i = 0; i < inverse.open.size(); ++i)
    if (inverse.open[i] > kMuch) out.open.push_back(linear.names[static_cast<std::size_t>(i)]);
  return out;
}

/// Standard deviation of residuals in their own standard deviations, with the weights of the loss.
double noise_of_residuals(const std::vector<double>& sigmas, double noise) {
  if (sigmas.empty()) return 1.0;
  constexpr int kIterations = 6;
  for (int i = 0; i < kIterations; ++i) {
    double sum = 0.0;
    for (const double sigma : sigmas)
      sum += robust_weight(std::abs(sigma) / noise) * sigma * sigma;
    noise = std::max(std::sqrt(sum / static_cast<double>(sigmas.size())), 1e-9);
  }
  return noise;
}

double median_of_magnitudes(std::vector<double> values) {
  if (values.empty()) return 1.0;
  for (double& value : values)
    value = std::abs(value);
  return std::max(1.4826 * median(values), 1e-9);
}

double rms_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += value * value;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// Standard deviation of the table's angles from their estimated errors, by variance components.
double angle_sigma_of(const ArtifactParameters& parameters,
                      const ArtifactInverse& inverse,
                      double before_rad) {
  constexpr double kLeast_rad = 1e-5;  // 0.0006 degrees, beyond rotary stages
  double squares = 0.0;
  double effective = 0.0;
  for (std::size_t c = 0; c < parameters.angle_errors.size(); ++c) {
    for (std::size_t v = 1; v < parameters.angle_errors[c].size(); ++v) {
      const auto at =
          std::find(inverse.names.begin(), inverse.names.end(), fmt::format("angle.{}.{}", c, v));
      const auto row = static_cast<Eigen::Index>(at - inverse.names.begin());
      squares += parameters.angle_errors[c][v] * parameters.angle_errors[c][v];
      effective += 1.0 - inverse.covariance(row, row) / (before_rad * before_rad);
    }
  }
  if (effective < 0.5) return before_rad;  // the data says nothing of them
  return std::max(std::sqrt(squares / effective), kLeast_rad);
}

struct ArtifactFit {
  ArtifactParameters parameters;
  ArtifactNoise noise;
  ArtifactInverse inverse;
};

void adjust_in_rounds(const ArtifactProblem& problem, ArtifactFit& fit, const Run& run) {
  constexpr int kRounds = 12;
  constexpr double kSettled = 0.02;
  for (int i = 0; i < kRounds; ++i) {
    const ArtifactResiduals before = artifact_residuals(problem, fit.parameters);
    if (i == 0) {
      // The start may be off by far more than the noise, and all of it counts.
      fit.noise.light = 3.0 * median_of_magnitudes(before.light_sigmas);
    }
    if (!adjust_artifacts(problem, fit.noise, fit.parameters, run)) {
      throw Error(ErrorKind::Numeric,
                  "the calibration does not converge; check angle_deg of each view and the sense "
                  "in which it counts, and that rig.toml is right within a few degrees and 10 %");
    }
    const ArtifactNoise last = fit.noise;
    const ArtifactResiduals after = artifact_residuals(problem, fit.parameters);
    fit.noise.light =
        noise_of_residuals(after.light_sigmas, median_of_magnitudes(after.light_sigmas));
    fit.inverse = invert_artifacts(linearize_artifacts(problem, fit.noise, fit.parameters));
    // While the noise of the phases is overestimated, the prior alone holds the angles.
    constexpr double kNear = 0.2;
    const double change = std::abs(fit.noise.light / last.light - 1.0);
    if (change < kNear)
      fit.noise.angle_rad = angle_sigma_of(fit.parameters, fit.inverse, last.angle_rad);
    const bool settled =
        change < kSettled && std::abs(fit.noise.angle_rad / last.angle_rad - 1.0) < 5.0 * kSettled;
    if (settled) break;
  }
}

/// Every eighth site of each view.
std::vector<ArtifactCapture> thinned(std::span<const ArtifactCapture> captures) {
  constexpr std::size_t kEvery = 8;
  std::vector<ArtifactCapture> some;
  for (const ArtifactCapture& capture : captures) {
    some.push_back({capture.artifact, {}, capture.surfaces});
    for (const ArtifactView& view : capture.views) {
      ArtifactView few{view.name, view.angle_rad, {}, {}, {}};
      for (std::size_t i = 0; i < view.sites.size(); i += kEvery) {
        few.sites.push_back(view.sites[i]);
        few.surface.push_back(view.surface[i]);
      }
      some.back().views.push_back(std::move(few));
    }
  }
  return some;
}

/// Estimates the terms of the wavefront that the residuals call for.
void release_wavefront(ArtifactProblem& problem, ArtifactFit& fit, const Run& run) {
  for (;;) {
    const auto missing = missing_wavefront_terms(problem, fit.noise, fit.parameters);
    if (std::none_of(missing.begin(), missing.end(), [](bool is) { return is; })) return;
    for (std::size_t i = 0; i < missing.size(); ++i)
      problem.free_wavefront.at(i) = problem.free_wavefront.at(i) || missing.at(i);
    adjust_in_rounds(problem, fit, run);
  }
}

/// Covariance by the names of the rig; parameters that are held have none.
void set_covariance(const ArtifactInverse& inverse, ArtifactSolution& out) {
  out.parameters = rig_parameter_names(out.rig);
  const auto count = static_cast<Eigen::Index>(out.parameters.size());
  out.covariance = Eigen::MatrixXd::Zero(count, count);
  std::vector<Eigen::Index> column;
  for (const std::string& name : out.parameters) {
    const auto at = std::find(inverse.names.begin(), inverse.names.end(), name);
    column.push_back(at == inverse.names.end() ? -1 : at - inverse.names.begin());
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::Index a = column[static_cast<std::size_t>(i)];
      const Eigen::Index b = column[static_cast<std::size_t>(k)];
      if (a >= 0 && b >= 0) out.covariance(i, k) = inverse.covariance(a, b);
    }
  }
  const auto sigma = [&](const char* name) {
    const auto at = std::find(inverse.names.begin(), inverse.names.end(), name);
    const auto row = static_cast<Eigen::Index>(at - inverse.names.begin());
    return std::sqrt(std::max(inverse.covariance(row, row), 0.0));
  };
  out.axis_sigma_rad = std::max(sigma("turntable.tilt_1"), sigma("turntable.tilt_2"));
  out.point_sigma_mm = std::max(sigma("turntable.shift_1"), sigma("turntable.shift_2"));
}

std::vector<std::string> held_directions(const ArtifactProblem& problem) {
  std::vector<std::string> held;
  if (problem.start.projector.is_angular())
    held.emplace_back("shift of the projector along its fringes");
  held.emplace_back("shift of the turntable's point along its axis");
  if (!problem.free_camera) held.emplace_back("intrinsics of the camera");
  if (!problem.start.projector.is_angular() && !problem.free_intrinsics)
    held.emplace_back("intrinsics of the projector");
  if (!problem.has_scale && !problem.options.baseline_mm && !problem.free_intrinsics)
    held.emplace_back("scale");
  return held;
}

}  // namespace

ArtifactSolution solve_artifacts(std::span<const ArtifactCapture> captures,
                                 const Rig& start,
                                 const ArtifactSolveOptions& options,
                                 const Run& run) {
  check_artifact_captures(captures, start);
  ArtifactProblem problem;
  problem.captures = captures;
  problem.start = start;
  problem.options = options;
  set_artifact_prior(start, problem);
  for (const ArtifactCapture& capture : captures)
    problem.has_scale = problem.has_scale || std::holds_alternative<Balls>(capture.artifact);
  ArtifactFit fit{artifact_start(problem), {}, {}};
  std::copy(fit.parameters.camera.begin(), fit.parameters.camera.end(), problem.prior_mean.begin());
  std::copy(fit.parameters.projector.begin(),
            fit.parameters.projector.end(),
            problem.prior_mean.begin() + 9);
  std::copy(
      fit.parameters.pose.begin(), fit.parameters.pose.end(), problem.prior_mean.begin() + 18);
  problem.prior_mean[24] = fit.parameters.pitch_scale;
  for (std::size_t i = 0; i < Wavefront::kTerms; ++i)
    problem.free_wavefront.at(i) = fit.parameters.wavefront.at(i) != 0.0;
  fit.noise.angle_rad = options.angle_sigma_rad;
  // A start of some degrees takes many iterations, for which few sites are enough.
  const std::vector<ArtifactCapture> some = thinned(captures);
  problem.captures = some;
  adjust_in_rounds(problem, fit, run);
  problem.captures = captures;
  fit.noise.angle_rad = options.angle_sigma_rad;
  adjust_in_rounds(problem, fit, run);
  release_wavefront(problem, fit, run);
  if (!fit.inverse.open.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("the views do not determine {}; add views at other angles of the "
                            "turntable, or another artifact",
                            fmt::join(fit.inverse.open, ", ")));
  }
  ArtifactSolution out;
  out.held = held_directions(problem);
  out.rig = artifact_rig(problem, fit.parameters);
  out.angle_errors_rad = fit.parameters.angle_errors;
  for (std::size_t c = 0; c < captures.size(); ++c) {
    out.surfaces.emplace_back();
    out.diameters_mm.emplace_back();
    for (std::size_t s = 0; s < captures[c].surfaces.size(); ++s) {
      out.surfaces.back().push_back(artifact_surface(problem, c, s, fit.parameters));
      if (const auto* balls = std::get_if<Balls>(&captures[c].artifact)) {
        out.diameters_mm.back().push_back(balls->diameter_mm *
                                          (1.0 + fit.parameters.surfaces[c][s][3]));
      }
    }
  }
  const ArtifactResiduals residuals = artifact_residuals(problem, fit.parameters);
  out.light_rms = rms_of(residuals.light);
  out.light_noise = fit.noise.light;
  if (start.laser_sheet) {
    const SheetFit sheet =
        fit_sheet(artifact_line_points(problem, fit.parameters), *start.laser_sheet);
    out.rig.laser_sheet = sheet.sheet;
    out.line_rms_mm = sheet.rms_mm;
    if (sheet.points == 0) out.held.emplace_back("laser sheet");
  }
  out.angle_sigma_rad = fit.noise.angle_rad;
  set_covariance(fit.inverse, out);
  out.rig.turntable->point_sigma_mm = out.point_sigma_mm;
  out.rig.turntable->axis_sigma_rad = out.axis_sigma_rad;
  out.rig.turntable->angle_sigma_rad = out.angle_sigma_rad;
  return out;
}

}  // namespace frangia
