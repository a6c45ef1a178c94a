#include "frangia/registration/refine_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/registration/internal/drift_bundle.h"
#include "frangia/registration/internal/drift_model.h"
#include "frangia/registration/internal/drift_views.h"
#include "frangia/registration/internal/known_length.h"
#include "frangia/registration/internal/optimize_bundle.h"

namespace frangia {
namespace {

/// Surfels of a view that are compared with the other views.
constexpr std::size_t kComparedSurfels = 6000;

double rms_within(const DriftSums& sums) {
  double squares = 0.0;
  for (const float distance : sums.distances_mm)
    squares += static_cast<double>(distance) * static_cast<double>(distance);
  return std::sqrt(squares /
                   static_cast<double>(std::max<std::size_t>(1, sums.distances_mm.size())));
}

Rig with_table(Rig rig, const Turntable& given, const Turntable& refined) {
  rig.turntable = refined;
  rig.turntable->point_mm += refined.axis * refined.axis.dot(given.point_mm - refined.point_mm);
  return rig;
}

std::vector<RefinedParameter> describe(const DriftModel& model,
                                       const Eigen::VectorXd& w,
                                       const RigCovariance& after,
                                       const RigRefinement& result) {
  constexpr double kDetermined = 1.0 / 3.0;  // of the prior's standard deviation
  Eigen::VectorXd changes = product(model.factor(), w);
  // The translation is the last of the parameters, and the scale changes it alone.
  const Projector& projector = result.rig.projector;
  changes.tail<3>() -= (1.0 - 1.0 / result.scale) * (projector.rotation * projector.position_mm);
  const Eigen::VectorXd prior = model.factor().rowwise().norm();
  std::vector<RefinedParameter> parameters;
  for (std::size_t i = 0; i < model.parameters().size(); ++i) {
    const std::string& name = model.parameters()[i];
    const auto at = std::find(after.parameters.begin(), after.parameters.end(), name) -
                    after.parameters.begin();
    const auto row = static_cast<Eigen::Index>(i);
    const double sigma = std::sqrt(std::max(0.0, after.covariance(at, at)));
    parameters.push_back({name, changes[row], prior[row], sigma, sigma < kDetermined * prior[row]});
  }
  return parameters;
}

Calibration refined_calibration(const Rig& given, RigCovariance covariance, std::size_t views) {
  Calibration calibration = given.calibration.value_or(Calibration{});
  if (!given.calibration) {
    calibration.board = "part";
    calibration.poses = static_cast<int>(views);
  }
  calibration.sigma.clear();
  for (std::size_t i = 0; i < covariance.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    calibration.sigma.emplace_back(covariance.parameters[i],
                                   std::sqrt(std::max(0.0, covariance.covariance(row, row))));
  }
  calibration.covariance = std::move(covariance);
  return calibration;
}

/// Holds the directions of w in which the information of the surfaces falls short of a share of the
/// prior's. The scale is one: shrinking all surfaces shrinks their distances, too, and would go on
/// without end, whatever prior the axis has.
void hold_undetermined(DriftBundle& bundle, double min_gain) {
  constexpr double kUnknown = 100.0;  // times the standard deviations of axis and angles
  const Eigen::Index count = bundle.state.w.size();
  bundle.free_directions = Eigen::MatrixXd::Identity(count, count);
  const DriftSums sums = sum_drift(bundle, kComparedSurfels);
  const auto eigen =
      symmetric_eigen(evidence_of(bundle, sums, kUnknown * bundle.table_sigma).hessian);
  Eigen::Index first = 0;
  while (first < eigen.values.size() && eigen.values[first] < min_gain)
    ++first;
  bundle.free_directions = eigen.vectors.rightCols(eigen.values.size() - first);
  bundle.state.w =
      product(bundle.free_directions, transposed_product(bundle.free_directions, bundle.state.w));
}

/// A refinement in progress: the rig and the surfaces that it is refined by.
class RigFit {
 public:
  RigFit(const Rig& rig,
         std::span<const RigSurfaces> surfaces,
         std::span<const Station> stations,
         const RefineRigOptions& options,
         const Run& run)
      : RigFit(rig, surfaces, stations, options, run, drift_views(surfaces, rig, rig, false, run)) {
  }

  /// Axis and angles alone: what registration would make of the given rig.
  void fit_table() {
    linearize();
    optimize_drift(bundle_, kComparedSurfels, options_.table.max_iterations, run_);
    alone_ = {bundle_.state, bundle_.gate_mm};
    if (sum_drift(bundle_, kComparedSurfels).distances_mm.empty()) {
      throw Error(ErrorKind::Input,
                  "the surfaces of the views do not overlap, so they do not determine the rig");
    }
  }

  /// The rig with them, in rounds of triangulation and linearization.
  void fit_rig() {
    constexpr double kReopened = 3.0;    // of the gate at the end of the last round
    constexpr double kConverged = 0.01;  // standard deviations of the prior
    const double reach_mm = options_.table.relative_reach * scale_.distance_mm;
    for (int round = 0; round < options_.max_rounds; ++round) {
      run_.report(static_cast<double>(round) / options_.max_rounds);
      // The fit of the first rounds is not yet as good as the noise allows.
      if (round < 2) hold_undetermined(bundle_, options_.min_gain);
      bundle_.gate_mm = round == 0 ? reach_mm : std::min(reach_mm, kReopened * bundle_.gate_mm);
      optimize_drift(bundle_, kComparedSurfels, options_.table.max_iterations, run_);
      const bool converged =
          round > 0 && (bundle_.state.w - bundle_.linearized_at).norm() < kConverged;
      triangulate(model_.rig_at(bundle_.state.w), true);
      if (converged) break;
    }
    optimize_drift(bundle_, kComparedSurfels, options_.table.max_iterations, run_);
  }

  /// What the surfaces tell of the changes of the rig; what is held is not measured.
  [[nodiscard]] Eigen::MatrixXd information(RigRefinement& result) {
    const Eigen::MatrixXd free_directions = bundle_.free_directions;
    bundle_.free_directions = Eigen::MatrixXd::Identity(model_.count(), model_.count());
    const Eigen::MatrixXd all = information_of(bundle_, sum_drift(bundle_, kComparedSurfels));
    result.directions = static_cast<std::size_t>(model_.count());
    result.held = result.directions - static_cast<std::size_t>(free_directions.cols());
    return congruence(product_transposed(free_directions, free_directions), all);
  }

  /// Compares both rigs by the wider of their gates, and keeps the better one.
  void keep_better_rig(RigRefinement& result) {
    const double gate_mm = std::max(alone_.gate_mm, bundle_.gate_mm);
    bundle_.gate_mm = gate_mm;
    bundle_.state.w = bundle_.linearized_at;
    const DriftSums after = sum_drift(bundle_, kComparedSurfels);
    std::vector<DriftView> views = std::move(bundle_.views);
    DriftBundle found = bundle_;
    found.views = std::move(views);
    triangulate(rig_, false);
    bundle_.state = alone_.state;
    linearize();
    const DriftSums given = sum_drift(bundle_, kComparedSurfels);
    result.rms_before_mm = rms_within(given);
    result.rms_after_mm = rms_within(after);
    const double fewest = 0.99 * static_cast<double>(given.distances_mm.size());
    result.kept_rig =
        static_cast<double>(after.distances_mm.size()) < fewest ||
        static_cast<double>(median(given.distances_mm)) <
            options_.as_good_as_given * static_cast<double>(median(after.distances_mm));
    result.rig = rig_;
    const TableState& end = (result.kept_rig ? bundle_ : found).state.table;
    result.angles_rad = end.angles_rad;
    if (result.kept_rig) return;
    bundle_ = std::move(found);
    result.rig = refined_;
    if (rig_.turntable) result.rig = with_table(refined_, *rig_.turntable, end.table);
  }

  /// Widens the standard deviations of parameters that are farther from the rig's than they allow.
  /// Returns whether any are. Where no change that was found is beyond them, one that would spare
  /// less than the errors that surfaces of sound scans have in common is none.
  [[nodiscard]] bool widen() {
    constexpr double kNoticeably = 1.3;
    constexpr double kBeyond = 3.0;  // standard deviations
    DriftBundle all = bundle_;
    all.free_directions = Eigen::MatrixXd::Identity(model_.count(), model_.count());
    const DriftSums sums = sum_drift(all, kComparedSurfels);
    const DriftEvidence evidence = evidence_of(all, sums, all.table_sigma);
    const DriftHypotheses hypotheses{model_.groups(),
                                     static_cast<Eigen::Index>(model_.parameters().size()),
                                     [&](const Eigen::VectorXd& widening) -> Eigen::MatrixXd {
                                       return least_squares(model_.factor(),
                                                            model_widened_by(widening).factor());
                                     }};
    const Eigen::VectorXd wider = widening_by_evidence(hypotheses, evidence, bundle_.state.w);
    const double pairs = sums.weight(all) * static_cast<double>(sums.distances_mm.size());
    const double gain = gain_by_widening(hypotheses, evidence, bundle_.state.w, wider);
    const double effect_mm = bundle_.noise_mm * std::sqrt(gain / pairs);
    const bool is_beyond = bundle_.state.w.cwiseAbs().maxCoeff() > kBeyond;
    if (!is_beyond && effect_mm < kCommonErrors * bundle_.systematic_mm) return false;
    if (widening_.size() == 0) widening_ = Eigen::VectorXd::Ones(wider.size());
    if ((wider.cwiseQuotient(widening_)).maxCoeff() < kNoticeably) return false;
    widening_ = wider;
    const Eigen::VectorXd changes = product(model_.factor(), bundle_.state.w);
    model_ = model_widened_by(widening_);
    bundle_.state.w = least_squares(model_.factor(), changes);
    linearize();
    return true;
  }
  /// The parameters that are farther from the rig's than their standard deviations allow.
  [[nodiscard]] std::vector<std::string> beyond_prior() const {
    constexpr double kMuch = 2.0;
    std::vector<std::string> names;
    for (Eigen::Index i = 0; i < widening_.size(); ++i)
      if (widening_[i] > kMuch) names.push_back(model_.parameters()[static_cast<std::size_t>(i)]);
    return names;
  }

  [[nodiscard]] const DriftBundle& bundle() const { return bundle_; }
  [[nodiscard]] const DriftModel& model() const { return model_; }

 private:
  struct TableFit {
    DriftState state;
    double gate_mm = 0.0;
  };

  RigFit(const Rig& rig,
         std::span<const RigSurfaces> surfaces,
         std::span<const Station> stations,
         const RefineRigOptions& options,
         const Run& run,
         std::vector<DriftView> views)
      : rig_(rig),
        surfaces_(surfaces),
        options_(options),
        run_(run),
        scale_(scale_of(views)),
        model_(rig, options, scale_.distance_mm),
        refined_(rig),
        bundle_(bundle_of(std::move(views), stations)),
        alone_{bundle_.state, bundle_.gate_mm} {
    if (count_pairs(bundle_.pairs) > 0) return;
    throw Error(ErrorKind::Input,
                "no two surfaces of the scan can be compared: refining a rig needs several views "
                "on its turntable, or fringes in both directions");
  }

  [[nodiscard]] DriftBundle bundle_of(std::vector<DriftView> views,
                                      std::span<const Station> stations) const {
    constexpr double kGateSigmas = 6.0;  // of one surfel: over four of a pair's
    TableState table{rig_.turntable.value_or(Turntable{}), {}, {}, {}};
    for (const Station& station : stations)
      table.angles_rad.push_back(station.angle_rad);
    const FastCameraModel camera(rig_.reference().model);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(model_.count());
    const RegisterOptions& how = options_.table;
    DriftBundle bundle{.views = std::move(views),
                       .camera = camera,
                       .linearized_at = none,
                       .free_directions = Eigen::MatrixXd(model_.count(), 0),
                       .given = table,
                       .table_sigma = prior_sigmas(table, how, scale_.distance_mm),
                       .pairs = {},
                       .noise_mm = scale_.sigma_mm * std::sqrt(2.0),
                       .min_gate_mm = kGateSigmas * scale_.sigma_mm,
                       .systematic_mm = how.relative_systematic * scale_.distance_mm,
                       .gate_mm = how.relative_reach * scale_.distance_mm,
                       .state = {none, table}};
    bundle.pairs =
        comparable_pairs(bundle.views, stations, table, camera, rig_.turntable.has_value());
    return bundle;
  }

  [[nodiscard]] DriftModel model_widened_by(const Eigen::VectorXd& widening) const {
    return DriftModel(rig_, options_, scale_.distance_mm, widening);
  }

  void linearize() {
    bundle_.linearized_at = bundle_.state.w;
    differentiate(bundle_.views, surfaces_, PointDrift(model_, bundle_.state.w));
  }

  /// The surfaces as another rig measures them.
  void triangulate(const Rig& by, bool changed) {
    bundle_.views = drift_views(surfaces_, rig_, by, changed, run_);
    bundle_.camera = FastCameraModel(by.reference().model);
    if (!changed) return;
    refined_ = by;
    linearize();
  }

  const Rig& rig_;
  std::span<const RigSurfaces> surfaces_;
  const RefineRigOptions& options_;
  const Run& run_;
  SurfelScale scale_;
  DriftModel model_;
  Eigen::VectorXd widening_;  ///< of the model; empty: none
  Rig refined_;
  DriftBundle bundle_;
  TableFit alone_;
};

}  // namespace

void RefineRigOptions::check() const {
  require(rotation_sigma_rad > 0.0, "RefineRigOptions: rotation_sigma_rad must be above 0");
  require(relative_position_sigma > 0.0,
          "RefineRigOptions: relative_position_sigma must be above 0");
  require(relative_focal_sigma > 0.0, "RefineRigOptions: relative_focal_sigma must be above 0");
  require(relative_principal_sigma > 0.0,
          "RefineRigOptions: relative_principal_sigma must be above 0");
  require(relative_distortion_sigma > 0.0,
          "RefineRigOptions: relative_distortion_sigma must be above 0");
  require(max_rounds >= 1, "RefineRigOptions: max_rounds must be at least 1");
  require(min_gain >= 0.0, "RefineRigOptions: min_gain must not be negative");
  table.check();
}

RigRefinement refine_rig(const Rig& rig,
                         std::span<const RigSurfaces> surfaces,
                         std::span<const Station> stations,
                         const RefineRigOptions& options,
                         const Run& run) {
  options.check();
  for (const RigSurfaces& surface : surfaces)
    require(surface.stations.size() == surface.views.size(),
            "refine_rig: each view needs a station");
  RigRefinement result;
  RigFit fit(rig, surfaces, stations, options, run);
  fit.fit_table();
  fit.fit_rig();
  constexpr int kMostWidenings = 3;
  for (int turn = 0; turn < kMostWidenings && fit.widen(); ++turn)
    fit.fit_rig();
  Eigen::MatrixXd information = fit.information(result);
  fit.keep_better_rig(result);
  if (!result.kept_rig) result.beyond_prior = fit.beyond_prior();
  if (options.ball_distance_mm) {
    const KnownLength length = measure_known_length(fit.bundle(), options);
    information += length.information;
    scale_rig(result.rig, length.scale);
    result.scale = length.scale;
  }
  if (rig.turntable)
    result.axis_moved_mm = (result.rig.turntable->point_mm - rig.turntable->point_mm).norm();
  const RigCovariance covariance = fit.model().updated(information);
  result.parameters = describe(fit.model(), fit.bundle().state.w, covariance, result);
  if (!result.kept_rig || options.ball_distance_mm)
    result.rig.calibration = refined_calibration(rig, covariance, stations.size());
  return result;
}

std::string RigRefinement::text() const {
  const std::string scaled =
      scale == 1.0 ? std::string("; no surface determines the scale: a known length does")
                   : fmt::format("; the known length scales the rig by {:.6f}", scale);
  if (kept_rig) {
    return fmt::format(
               "the rig is kept: its surfaces agree to {:.3g} mm RMS, and no drift explains them "
               "better ({:.3g} mm)",
               rms_before_mm,
               rms_after_mm) +
           scaled;
  }
  std::vector<std::string> held_names;
  for (const RefinedParameter& parameter : parameters)
    if (!parameter.determined) held_names.push_back(parameter.name);
  std::string words = fmt::format(
      "the rig has drifted: its surfaces agree to {:.3g} mm RMS (before: {:.3g} mm); the part "
      "determines {} of {} independent changes, and the others are held",
      rms_after_mm,
      rms_before_mm,
      directions - held,
      directions);
  if (!beyond_prior.empty()) {
    words +=
        fmt::format("; farther from the rig's than a drift goes, so that they count as open: {}",
                    fmt::join(beyond_prior, ", "));
  }
  words += scaled;
  if (!held_names.empty()) {
    words += fmt::format("; not determined by themselves: {}", fmt::join(held_names, ", "));
  }
  return words;
}

}  // namespace frangia
