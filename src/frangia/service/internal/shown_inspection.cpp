#include "frangia/service/internal/shown_inspection.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

/// How far a pose turns and moves the surface, and how it fits then.
Json json_of_pose(const AlignmentPose& pose) {
  const Eigen::Isometry3d& motion = pose.reference_from_mesh;
  return {{"turned_deg", deg_from_rad(Eigen::AngleAxisd(motion.linear()).angle())},
          {"moved_mm", motion.translation().norm()},
          {"overlap", pose.overlap},
          {"rms_mm", finite_or_null(pose.rms_mm)}};
}

}  // namespace

std::shared_ptr<const ShownInspection> shown_inspection(const Mesh& mesh,
                                                        const InspectionPlan& plan,
                                                        const std::string& reference,
                                                        int count,
                                                        const Run& run) {
  constexpr std::size_t kHistogramBins = 48;
  constexpr double kScaleOverTolerance = 2.0;
  auto shown = std::make_shared<ShownInspection>();
  shown->revision = count;
  shown->reference = reference;
  shown->plan = plan;
  std::optional<InspectionReference> nominal;
  if (!plan.reference.empty()) {
    run.stage("reference");
    nominal = read_inspection_reference(plan.reference, {.unit_mm = plan.unit_mm}, run);
  }
  const InspectOptions options{.statistics = false, .mesh_name = "the surface"};
  shown->found = inspect_part(mesh, nominal ? &*nominal : nullptr, plan, options, run);
  const ToleranceLimits limits = plan.tolerance();
  shown->high_mm = kScaleOverTolerance * std::max(std::abs(limits.lower), std::abs(limits.upper));
  shown->low_mm = -shown->high_mm;
  if (shown->found.surface) {
    shown->histogram = deviation_histogram(shown->found.mesh,
                                           shown->found.surface->deviations.deviation_mm,
                                           shown->low_mm,
                                           shown->high_mm,
                                           kHistogramBins);
  }
  shown->found.mesh = {};
  return shown;
}

nlohmann::ordered_json json_of_inspection(const ShownInspection& shown) {
  const SurfaceInspection& surface = shown.found.surface.value();
  const DeviationSummary& summary = surface.summary;
  const SurfaceVerdict& verdict = surface.verdict;
  const Alignment& alignment = shown.found.alignment.value();
  Json poses = Json::array();
  for (const AlignmentPose& pose : alignment.alternatives)
    poses.push_back(json_of_pose(pose));
  const auto& status = surface.deviations.status;
  const Json pose = json_of_pose(alignment.pose);
  return {{"revision", shown.revision},
          {"reference", shown.reference},
          {"reference_triangles", shown.found.reference->triangles},
          {"best_fit", shown.plan.align == "best-fit"},
          {"start", std::max<std::size_t>(shown.plan.start, 1)},
          {"poses", poses},
          {"tolerance_mm", {verdict.rule.limits.lower, verdict.rule.limits.upper}},
          {"scale_mm", {shown.low_mm, shown.high_mm}},
          {"histogram", shown.histogram},
          {"verdict", std::string(name_of(verdict.conformity))},
          {"sentence", sentence_of(verdict)},
          {"in_share", verdict.share_of(PatchDecision::In)},
          {"out_share", verdict.share_of(PatchDecision::Out)},
          {"undecided_share",
           verdict.share_of(PatchDecision::NearLimit) +
               verdict.share_of(PatchDecision::NotWellMeasured)},
          {"not_measured_share", verdict.share_of(PatchDecision::NotMeasured)},
          {"patch_mm", verdict.rule.min_feature_mm},
          {"rms_mm", finite_or_null(summary.rms_mm)},
          {"mean_mm", finite_or_null(summary.mean_mm)},
          {"min_mm", finite_or_null(summary.min_mm)},
          {"max_mm", finite_or_null(summary.max_mm)},
          {"median_u_mm", finite_or_null(summary.median_u_mm)},
          {"area_mm2", summary.area_mm2},
          {"overlap", pose.at("overlap")},
          {"fit_rms_mm", pose.at("rms_mm")},
          {"turned_deg", pose.at("turned_deg")},
          {"moved_mm", pose.at("moved_mm")},
          {"left_out",
           static_cast<std::size_t>(std::count_if(
               status.begin(),
               status.end(),
               [](DeviationStatus one) { return one != DeviationStatus::Compared; }))},
          {"free_directions", alignment.free_directions}};
}

}  // namespace frangia
