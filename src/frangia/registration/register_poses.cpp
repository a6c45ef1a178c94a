#include "frangia/registration/register_poses.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/free_pose_bundle.h"

namespace frangia {
namespace {

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += value * value;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

double matched_share(const FreePoseSums& sums) {
  return static_cast<double>(sums.matched) /
         static_cast<double>(std::max<std::size_t>(1, sums.surfels));
}

FreePoseBundle make_free_pose_bundle(const ViewStore& views,
                                     std::span<const SurfelMap> maps,
                                     const CameraModel& camera) {
  const std::size_t surfels = surfels_per_view(3000, views.size());
  FreePoseBundle bundle{maps, {}, {}, FastCameraModel(camera), {}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    bundle.surfels.push_back(pick_surfels(bundle.maps[i], surfels));
    bundle.rig_from_world.push_back(views.rig_from_object(i));
  }
  bundle.pairs = choose_view_pairs(bundle.maps, bundle.model, bundle.rig_from_world);
  return bundle;
}

/// The standard deviation of given poses that the surfaces show, where they determine motions by
/// which the poses are off; the motions that they do not determine are off as much. None where the
/// poses are off by little more than noise: surfaces laid them, which says nothing of the others.
std::optional<double> sigma_shown(const FreePoseBundle& bundle,
                                  const FreePoseSums& sums,
                                  std::span<const Eigen::Isometry3d> given) {
  constexpr std::size_t kFewest = 6;  // motions: their root mean square is known to a third
  constexpr double kOverNoise = 5.0;
  const DeterminedOffsets offsets = determined_offsets(bundle, sums, given);
  if (offsets.count < kFewest || offsets.rms_mm < kOverNoise * offsets.sigma_mm) return {};
  // Of few motions the root mean square may be small by chance.
  return offsets.rms_mm * (1.0 + 1.0 / std::sqrt(static_cast<double>(offsets.count)));
}

}  // namespace

void RegisterPosesOptions::check() const {
  require(reach_mm >= 0.0, "RegisterPosesOptions: reach_mm must not be negative");
  require(max_iterations >= 1, "RegisterPosesOptions: max_iterations must be at least 1");
  require(tolerance > 0.0, "RegisterPosesOptions: tolerance must be above 0");
  require(min_overlap >= 0.0, "RegisterPosesOptions: min_overlap must not be negative");
}

double default_reach_mm(std::span<const SurfelMap> maps) {
  constexpr double kShare = 0.03;
  constexpr std::size_t kSamples = 4000;
  std::vector<double> sizes_mm;
  for (const SurfelMap& map : maps) {
    Eigen::AlignedBox3f box;
    for (const SurfelMap::Surfel& surfel : pick_surfels(map, kSamples))
      box.extend(surfel.point_mm);
    if (!box.isEmpty()) sizes_mm.push_back(static_cast<double>(box.diagonal().norm()));
  }
  return kShare * median(std::move(sizes_mm));
}

PosesReport register_poses(ViewStore& views,
                           std::span<const SurfelMap> maps,
                           const CameraModel& camera,
                           const RegisterPosesOptions& options,
                           const Run& run) {
  options.check();
  require(maps.size() == views.size(),
          "register_poses: the number of maps differs from the number of views");
  PosesReport report;
  if (views.size() < 2) return report;
  const double reach_mm = options.reach_mm > 0.0 ? options.reach_mm : default_reach_mm(maps);
  FreePoseBundle bundle = make_free_pose_bundle(views, maps, camera);
  FreePoseSums sums = sum_free_poses(bundle, reach_mm);
  report.rms_before_mm = report.rms_after_mm = root_mean_square(sums.distances_mm);
  report.overlap = matched_share(sums);
  if (report.overlap < options.min_overlap || sums.matched == 0) {
    run.warn(
        "the scans do not overlap where their poses put them: the poses are kept; find them from "
        "the shape instead, or allow a larger `max_distance`");
    return report;
  }
  const double prior_mm = options.prior_mm > 0.0 ? options.prior_mm : reach_mm;
  const std::vector<Eigen::Isometry3d> given = bundle.rig_from_world;
  RestedEquations rested;
  const auto linearize = [&](double gate_mm) {
    sums = sum_free_poses(bundle, gate_mm);
    rested = rest_on_given(bundle, sums, given, prior_mm);
    return Linearization{std::move(rested.hessian),
                         std::move(rested.gradient),
                         median(sums.distances_mm),
                         1.0,
                         matched_share(sums) >= options.min_overlap};
  };
  const auto update = [&](const Eigen::VectorXd& step) {
    apply_update(bundle, product(rested.to, step));
  };
  const GaussNewtonResult result = minimize_robustly(
      {linearize, update},
      {.gate = reach_mm, .max_iterations = options.max_iterations, .tolerance = options.tolerance},
      run);
  sums = sum_free_poses(bundle, result.gate);
  if (matched_share(sums) < options.min_overlap) {
    run.warn("the overlap of the scans is lost while their poses are refined: the poses are kept");
    return report;
  }
  report.rms_after_mm = root_mean_square(sums.distances_mm);
  report.overlap = matched_share(sums);
  report.iterations = result.iterations;
  for (std::size_t i = 0; i < views.size(); ++i)
    views.set_rig_from_object(i, bundle.rig_from_world[i]);
  report.given_sigma_mm = prior_mm;
  const bool assumed = !(options.prior_mm > 0.0) && !(options.reach_mm > 0.0);
  const auto shown = assumed ? sigma_shown(bundle, sums, given) : std::nullopt;
  if (shown) report.given_sigma_mm = std::min(prior_mm, *shown);
  report.motions = motions_of_free_poses(bundle, sums, report.given_sigma_mm);
  return report;
}

std::string PosesReport::text() const {
  return fmt::format(
      "scans agree to {:.3g} mm RMS (before: {:.3g} mm), {:.0f} % of their points overlap",
      rms_after_mm,
      rms_before_mm,
      100.0 * overlap);
}

}  // namespace frangia
