#include "frangia/inspection/align_part.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/features/find_features.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/inspection/internal/assign_features.h"
#include "frangia/inspection/measured_characteristics.h"
#include "frangia/inspection/planned_nominals.h"

namespace frangia {
namespace {

BestFitOptions fit_options_of(const InspectionPlan& plan) {
  BestFitOptions options;
  options.tolerance_mm = plan.overlap_tolerance_mm();
  options.reference_unit_mm = plan.unit_mm.value_or(1.0);
  return options;
}

Alignment best_fit(const Mesh& mesh,
                   const InspectionReference& reference,
                   const InspectionPlan& plan,
                   const Run& run) {
  BestFitOptions options = fit_options_of(plan);
  if (!plan.points.empty()) options.from = align_to_points(plan.points).reference_from_mesh;
  if (plan.start > 0) options.start = plan.start - 1;
  return align_best_fit(mesh, reference.scene, options, run);
}

const Feature& found_datum(const PlannedFeature& planned,
                           const std::vector<Feature>& features,
                           const Mesh& mesh,
                           const std::filesystem::path& on) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.allFinite()) box.extend(vertex);
  const double farthest_mm = kFarthestFeature * static_cast<double>(box.diagonal().norm());
  const Feature* feature = nearest_feature(planned, features, farthest_mm);
  if (feature == nullptr) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: datum \"{}\": there is no {} near ({:g}, {:g}, {:g}); check its "
                            "near_mm, in the frame of the reference",
                            on.string(),
                            planned.name,
                            name_of(planned.kind),
                            planned.near_mm.x(),
                            planned.near_mm.y(),
                            planned.near_mm.z()));
  }
  return *feature;
}

PartAlignment align_by_datums(const Mesh& mesh,
                              const InspectionReference& reference,
                              const InspectionPlan& plan,
                              const std::filesystem::path& mesh_name,
                              const Run& run) {
  require(!plan.datums.empty(),
          "align = \"datum\" needs datums, which name one to three of the plan's features");
  const std::vector<PlannedFeature> features = stated_features(plan, &reference);
  const auto reference_name =
      reference.file.empty() ? std::filesystem::path("the reference") : reference.file;
  PartAlignment fit{best_fit(mesh, reference, plan, run), {}, {}};
  const Mesh aligned = transform_mesh(mesh, fit.alignment.pose.reference_from_mesh);
  run.stage("datums");
  const std::vector<Feature> measured = find_features(
      aligned, {.edges = false, .wanted = inspection::planned_shapes(features, aligned)}, run);
  std::vector<Feature> nominal;  // searched where a datum names no face
  std::vector<Datum> datums;
  for (const std::string& name : plan.datums) {
    const auto planned = std::find_if(
        features.begin(), features.end(), [&](const auto& one) { return one.name == name; });
    require(planned != features.end(), "datums name a feature that the plan does not have");
    const Feature& seen = found_datum(*planned, measured, aligned, mesh_name);
    Datum datum{name, {}, seen.fit.shape, seen.uncertainty};
    if (planned->face > 0) {
      datum.nominal = reference.cad->faces()[planned->face - 1].shape.value();
    } else {
      if (nominal.empty()) {
        const Mesh& model = reference.scene.mesh();
        nominal = find_features(
            model, {.edges = false, .wanted = inspection::planned_shapes(features, model)}, run);
      }
      datum.nominal =
          found_datum(*planned, nominal, reference.scene.mesh(), reference_name).fit.shape;
    }
    datums.push_back(std::move(datum));
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : aligned.vertices_mm)
    box.extend(vertex.cast<double>());
  const DatumAlignment found = align_to_datums(datums, box.center(), 0.5 * box.diagonal().norm());
  const int iterations = fit.alignment.pose.iterations;
  AlignmentPose& pose = fit.alignment.pose;
  pose = assess_pose(
      mesh, reference.scene, found.motion * pose.reference_from_mesh, fit_options_of(plan), run);
  pose.iterations = iterations;
  pose.uncertainty = found.uncertainty;
  fit.alignment.alternatives = {pose};
  fit.alignment.free_directions = found.free_directions;
  fit.datums = found.residuals;
  return fit;
}

PartAlignment align_by_points(const Mesh& mesh,
                              const InspectionReference& reference,
                              const InspectionPlan& plan,
                              const Run& run) {
  const PointAlignment found = align_to_points(plan.points);
  PartAlignment fit;
  AlignmentPose& pose = fit.alignment.pose;
  pose = assess_pose(mesh, reference.scene, found.reference_from_mesh, fit_options_of(plan), run);
  pose.uncertainty = found.uncertainty;
  fit.alignment.alternatives = {pose};
  return fit;
}

PartAlignment aligned_part(const Mesh& mesh,
                           const InspectionReference& reference,
                           const InspectionPlan& plan,
                           const std::filesystem::path& mesh_name,
                           const Run& run) {
  if (plan.align == "datum") return align_by_datums(mesh, reference, plan, mesh_name, run);
  if (plan.align == "best-fit") return {best_fit(mesh, reference, plan, run), {}, {}};
  if (plan.align == "points") return align_by_points(mesh, reference, plan, run);
  PartAlignment as_it_stands;
  as_it_stands.alignment.pose =
      assess_pose(mesh, reference.scene, Eigen::Isometry3d::Identity(), fit_options_of(plan), run);
  return as_it_stands;
}

/// Warns of a mesh that hardly lies on the reference although nothing searched its pose: that of
/// another part, or of another frame. A part that is out of a narrow tolerance is no other part.
void warn_of_other_part(const Mesh& mesh,
                        const InspectionReference& reference,
                        const AlignmentPose& pose,
                        const std::filesystem::path& mesh_name,
                        const Run& run) {
  const BestFitOptions usual;
  if (pose.overlap >= usual.least_overlap) return;
  const double overlap =
      assess_pose(mesh, reference.scene, pose.reference_from_mesh, usual, run).overlap;
  if (overlap >= usual.least_overlap) return;
  run.warn(
      fmt::format("{}: {:.0f} % of it lies on the reference; it is another part, or `align` "
                  "best-fit must find its pose",
                  mesh_name.string(),
                  100.0 * overlap));
}

}  // namespace

PartAlignment align_part(const Mesh& mesh,
                         const InspectionReference& reference,
                         const InspectionPlan& plan,
                         const std::filesystem::path& mesh_name,
                         const Run& run) {
  PartAlignment found = aligned_part(mesh, reference, plan, mesh_name, run);
  if (plan.align == "points" || plan.align == "none")
    warn_of_other_part(mesh, reference, found.alignment.pose, mesh_name, run);
  for (const PointPair& pair : plan.points) {
    found.points_mm.push_back(
        (found.alignment.pose.reference_from_mesh * pair.scan_mm - pair.reference_mm).norm());
  }
  return found;
}

std::vector<PlannedFeature> stated_features(const InspectionPlan& plan,
                                            const InspectionReference* reference) {
  std::vector<PlannedFeature> features = plan.features;
  if (reference != nullptr && reference->cad) {
    state_nominals(features, reference->cad->faces(), plan.name());
  } else {
    check_without_cad(features, plan.name());
  }
  return features;
}

}  // namespace frangia
