#include "frangia/registration/refine_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/median.h"
#include "frangia/core/symmetric_eigen.h"
#include "frangia/registration/internal/drift_bundle.h"
#include "frangia/registration/internal/drift_model.h"
#include "frangia/registration/internal/drift_views.h"
#include "frangia/registration/internal/known_length.h"
#include "frangia/registration/internal/make_bundle.h"

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
  Eigen::VectorXd changes = model.factor() * w;
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
/// without end.
void hold_undetermined(DriftBundle& bundle, double min_gain) {
  const Eigen::Index count = bundle.state.w.size();
  bundle.free_directions = Eigen::MatrixXd::Identity(count, count);
  const auto eigen = symmetric_eigen(information_of(bundle, sum_drift(bundle, kComparedSurfels)));
  Eigen::Index first = 0;
  while (first < eigen.values.size() && eigen.values[first] < min_gain)
    ++first;
  bundle.free_directions = eigen.vectors.rightCols(eigen.values.size() - first);
  bundle.state.w =
      (bundle.free_directions * (bundle.free_directions.transpose() * bundle.state.w)).eval();
}

}  // namespace

void RefineRigOptions::check() const {
  require(rotation_sigma_rad > 0.0, "RefineRigOptions: rotation_sigma_rad must be above 0");
  require(relative_position_sigma > 0.0,
          "RefineRigOptions: relative_position_sigma must be above 0");
  require(relative_focal_sigma > 0.0, "RefineRigOptions: relative_focal_sigma must be above 0");
  require(relative_principal_sigma > 0.0,
          "RefineRigOptions: relative_principal_sigma must be above 0");
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
  const bool turns = rig.turntable.has_value();
  TableState table{rig.turntable.value_or(Turntable{}), {}, {}, {}};
  for (const Station& station : stations)
    table.angles_rad.push_back(station.angle_rad);
  std::vector<DriftView> views = drift_views(surfaces, rig, rig, false, run);
  const SurfelScale scale = scale_of(views);
  const DriftModel model(rig, options, scale.distance_mm);
  const FastCameraModel camera(rig.reference().model);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.count());
  constexpr double kGateSigmas = 6.0;  // of one surfel: over four of a pair's
  DriftBundle bundle{.views = std::move(views),
                     .camera = camera,
                     .linearized_at = none,
                     .free_directions = Eigen::MatrixXd(model.count(), 0),
                     .given = table,
                     .table_sigma = prior_sigmas(table, options.table, scale.distance_mm),
                     .pairs = {},
                     .noise_mm = scale.sigma_mm * std::sqrt(2.0),
                     .min_gate_mm = kGateSigmas * scale.sigma_mm,
                     .systematic_mm = options.table.relative_systematic * scale.distance_mm,
                     .gate_mm = options.table.relative_reach * scale.distance_mm,
                     .state = {none, table}};
  bundle.pairs = comparable_pairs(bundle.views, stations, table, camera, turns);
  if (count_pairs(bundle.pairs) == 0) {
    throw Error(ErrorKind::Input,
                "no two surfaces of the scan can be compared: refining a rig needs several views "
                "on its turntable, or fringes in both directions");
  }
  const auto linearize_at_state = [&] {
    bundle.linearized_at = bundle.state.w;
    differentiate(bundle.views, surfaces, PointDrift(model, bundle.state.w));
  };
  const double reach_mm = bundle.gate_mm;

  // Axis and angles alone: what registration would make of the given rig.
  linearize_at_state();
  optimize_drift(bundle, kComparedSurfels, options.table.max_iterations, run);
  const DriftState alone = bundle.state;
  const double gate_alone_mm = bundle.gate_mm;
  const DriftSums before = sum_drift(bundle, kComparedSurfels);
  if (before.distances_mm.empty()) {
    throw Error(ErrorKind::Input,
                "the surfaces of the views do not overlap, so they do not determine the rig");
  }

  // The rig with them, in rounds of triangulation and linearization.
  Rig refined = rig;
  for (int round = 0; round < options.max_rounds; ++round) {
    constexpr double kReopened = 3.0;    // of the gate at the end of the last round
    constexpr double kConverged = 0.01;  // standard deviations of the prior
    run.report(static_cast<double>(round) / options.max_rounds);
    // The fit of the first rounds is not yet as good as the noise allows.
    if (round < 2) hold_undetermined(bundle, options.min_gain);
    bundle.gate_mm = round == 0 ? reach_mm : std::min(reach_mm, kReopened * bundle.gate_mm);
    optimize_drift(bundle, kComparedSurfels, options.table.max_iterations, run);
    const bool converged = round > 0 && (bundle.state.w - bundle.linearized_at).norm() < kConverged;
    refined = model.rig_at(bundle.state.w);
    bundle.views = drift_views(surfaces, rig, refined, true, run);
    bundle.camera = FastCameraModel(refined.reference().model);
    linearize_at_state();
    if (converged) break;
  }
  optimize_drift(bundle, kComparedSurfels, options.table.max_iterations, run);
  const double gate_after_mm = bundle.gate_mm;
  const Eigen::MatrixXd free_directions = bundle.free_directions;
  bundle.free_directions = Eigen::MatrixXd::Identity(model.count(), model.count());
  const DriftSums final_sums = sum_drift(bundle, kComparedSurfels);
  Eigen::MatrixXd information = information_of(bundle, final_sums);
  // What is held is not measured.
  const Eigen::MatrixXd projection = free_directions * free_directions.transpose();
  information = (projection * information * projection).eval();

  RigRefinement result;
  result.directions = static_cast<std::size_t>(model.count());
  result.held = result.directions - static_cast<std::size_t>(free_directions.cols());

  // Both rigs by the wider of their gates.
  bundle.gate_mm = std::max(gate_alone_mm, gate_after_mm);
  bundle.state.w = bundle.linearized_at;
  const DriftSums after = sum_drift(bundle, kComparedSurfels);
  const DriftState found = bundle.state;
  std::vector<DriftView> refined_views = std::move(bundle.views);
  bundle.views = drift_views(surfaces, rig, rig, false, run);
  bundle.camera = camera;
  bundle.state = alone;
  linearize_at_state();
  const DriftSums given = sum_drift(bundle, kComparedSurfels);
  result.rms_before_mm = rms_within(given);
  result.rms_after_mm = rms_within(after);
  const double fewest = 0.99 * static_cast<double>(given.distances_mm.size());
  result.kept_rig = static_cast<double>(after.distances_mm.size()) < fewest ||
                    static_cast<double>(median(given.distances_mm)) <
                        options.as_good_as_given * static_cast<double>(median(after.distances_mm));
  if (!result.kept_rig) {
    bundle.views = std::move(refined_views);
    bundle.camera = FastCameraModel(refined.reference().model);
    bundle.state = found;
    bundle.linearized_at = found.w;
  }
  const TableState& end = bundle.state.table;
  result.angles_rad = end.angles_rad;
  result.rig = rig;
  if (!result.kept_rig)
    result.rig = turns ? with_table(refined, *rig.turntable, end.table) : refined;
  if (options.ball_distance_mm) {
    const KnownLength length = measure_known_length(bundle, options);
    information += length.information;
    scale_rig(result.rig, length.scale);
    result.scale = length.scale;
  }
  if (turns)
    result.axis_moved_mm = (result.rig.turntable->point_mm - rig.turntable->point_mm).norm();
  const RigCovariance covariance = model.updated(information);
  result.parameters = describe(model, bundle.state.w, covariance, result);
  if (!result.kept_rig || options.ball_distance_mm)
    result.rig.calibration = refined_calibration(rig, covariance, stations.size());
  return result;
}

}  // namespace frangia
