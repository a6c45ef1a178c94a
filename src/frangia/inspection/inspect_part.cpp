#include "frangia/inspection/inspect_part.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/features/shape_uncertainty.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/inspection/align_part.h"
#include "frangia/inspection/calibration_displacements.h"
#include "frangia/inspection/internal/assign_features.h"
#include "frangia/inspection/internal/view_poses.h"
#include "frangia/inspection/measure_on_surface.h"

namespace frangia {
namespace {

constexpr double kPerMillion = 1e-6;

/// What moves all features alike, as `FeaturePoints` has it: the calibration of the rig and the
/// temperature. The mesh still has the frame of its scan.
Eigen::MatrixXf shared_displacements(const Mesh& mesh,
                                     const InspectionPlan& plan,
                                     const Scan* scan,
                                     bool& knows_calibration,
                                     const Run& run) {
  Eigen::MatrixXf shared_mm;
  if (scan != nullptr) {
    shared_mm = calibration_displacements(mesh, *scan, run);
    knows_calibration = shared_mm.size() > 0;
  }
  if (!(plan.expansion_ppm_per_k * plan.temperature_u_k > 0.0)) return shared_mm;
  const Eigen::MatrixXf thermal =
      thermal_displacement(mesh, kPerMillion * plan.expansion_ppm_per_k, plan.temperature_u_k);
  shared_mm.conservativeResize(shared_mm.rows() + 1, thermal.cols());
  shared_mm.bottomRows(1) = thermal;
  return shared_mm;
}

/// Finds the features of the mesh and measures those of the plan.
void measure_features(Inspection& found,
                      const Eigen::MatrixXf& shared_mm,
                      const InspectionReference* reference,
                      const InspectionPlan& plan,
                      const InspectOptions& options,
                      const Run& run) {
  InspectionPlan stated = plan;
  stated.features = stated_features(plan, reference);
  if (!options.features && stated.features.empty()) {
    found.characteristics = measure_characteristics(stated, {}, run);  // those of the surface
    return;
  }
  run.stage("features");
  found.searched = true;
  found.features =
      find_features(found.mesh,
                    {.calibration_mm = &shared_mm,
                     .wanted = inspection::planned_shapes(stated.features, found.mesh)},
                    run);
  const bool has_cad = reference != nullptr && reference->cad;
  std::vector<MeasuredFeature> measured;
  if (!stated.features.empty() || has_cad) measured = with_points(found.mesh, found.features, run);
  if (has_cad) {
    for (const MeasuredFeature& feature : measured) {
      run.check();
      found.nominals.push_back(nominal_face(*reference->cad, reference->scene, feature));
    }
  }
  found.characteristics = measure_characteristics(stated, measured, run);
  found.named_features = named_features(stated, measured);
}

SurfaceStatistics statistics_of(const Mesh& mesh,
                                const Eigen::Isometry3d& mesh_from_reference,
                                const InspectionReference& reference,
                                const InspectOptions& options,
                                const Run& run) {
  run.stage("statistics");
  SurfaceStatistics found;
  found.within_mm = options.within_mm;
  found.of_views = options.scan != nullptr;
  const RayScene scene(mesh, run);
  found.error = surface_error(mesh, reference.scene, {.exact = reference.cad.get()}, run);
  const CompletenessOptions completeness{.within_mm = options.within_mm,
                                         .max_angle_rad = options.max_angle_rad};
  if (options.scan == nullptr) {
    found.completeness = surface_completeness(reference.scene, scene, completeness, run);
  } else {
    std::vector<Eigen::Isometry3d> poses = inspection::view_poses(*options.scan);
    for (Eigen::Isometry3d& pose : poses)  // the reference may lie elsewhere than the scan
      pose = pose * mesh_from_reference;
    found.completeness = surface_completeness(
        reference.scene, scene, MeasurementViews{options.scan->rig, poses}, completeness, run);
  }
  found.validity = surface_validity(mesh, reference.scene, run, reference.cad.get());
  return found;
}

SurfaceInspection judged_surface(const Inspection& part,
                                 const InspectionReference& reference,
                                 const InspectionPlan& plan,
                                 const Run& run) {
  DeviationOptions options;
  if (part.alignment) options.pose = part.alignment->pose.uncertainty;
  options.expansion_per_k = kPerMillion * plan.expansion_ppm_per_k;
  options.temperature_u_k = plan.temperature_u_k;
  options.exact = reference.cad.get();
  SurfaceRule rule = plan.surface;
  rule.limits = plan.tolerance();
  SurfaceInspection found = inspect_surface(part.mesh, reference.scene, rule, options, run);
  if (!(found.summary.area_mm2 > 0.0)) {
    throw Error(ErrorKind::Numeric,
                fmt::format("no part of the mesh can be compared with the reference; vertices left "
                            "out: {}; `align` best-fit finds the pose, and `units` states the unit "
                            "of the reference",
                            left_out_text(found.summary)));
  }
  return found;
}

MeasuredWalls measure_walls(const Mesh& mesh, const Run& run) {
  run.stage("thickness");
  MeasuredWalls walls;
  walls.thickness = thickness_of(RayScene(mesh, run), run);
  walls.summary = summarize(mesh, walls.thickness);
  return walls;
}

/// Moves the mesh onto the reference as the plan says.
void align_mesh(Inspection& found,
                const InspectionReference& reference,
                const InspectionPlan& plan,
                const InspectOptions& options,
                const Run& run) {
  if (plan.align.empty() || plan.align == "none") {
    const BestFitOptions unit{.reference_unit_mm = plan.unit_mm.value_or(1.0)};
    refuse_unit_of_pose(found.mesh, reference.scene, Eigen::Isometry3d::Identity(), unit, run);
  }
  if (plan.align.empty()) return;
  PartAlignment fit = align_part(found.mesh, reference, plan, options.mesh_name, run);
  found.alignment = std::move(fit.alignment);
  found.datums = std::move(fit.datums);
  found.points_mm = std::move(fit.points_mm);
  found.mesh = transform_mesh(std::move(found.mesh), found.alignment->pose.reference_from_mesh);
}

Inspection inspected(Mesh mesh,
                     const InspectionReference* reference,
                     const InspectionPlan& plan,
                     const InspectOptions& options,
                     const Run& run) {
  if (reference == nullptr && !plan.align.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: `align` is {}, but there is no reference to align the mesh to; "
                            "give one, or leave out `align`",
                            plan.name().string(),
                            plan.align));
  }
  Inspection found;
  found.mesh = std::move(mesh);
  Eigen::MatrixXf shared_mm;
  if (options.features || !plan.features.empty())
    shared_mm = shared_displacements(found.mesh, plan, options.scan, found.knows_calibration, run);
  if (reference != nullptr) {
    found.reference = {.triangles = reference->scene.mesh().triangles.size()};
    if (reference->cad) {
      found.reference->is_cad = true;
      found.reference->faces = reference->cad->faces().size();
      found.reference->unit = reference->cad->unit();
    }
    align_mesh(found, *reference, plan, options, run);
  }
  measure_features(found, shared_mm, reference, plan, options, run);
  if (reference != nullptr) {
    found.tolerance_is_default = !plan.tolerance_mm.has_value();
    found.surface = judged_surface(found, *reference, plan, run);
    if (options.statistics) {
      Eigen::Isometry3d mesh_from_reference = Eigen::Isometry3d::Identity();
      if (found.alignment)
        mesh_from_reference = found.alignment->pose.reference_from_mesh.inverse();
      found.statistics = statistics_of(found.mesh, mesh_from_reference, *reference, options, run);
    }
  }
  if (needs_walls(plan)) found.walls = measure_walls(found.mesh, run);
  found.sections =
      cut_sections(plan.sections,
                   found.mesh,
                   reference == nullptr ? nullptr : &reference->scene.mesh(),
                   found.surface ? found.surface->deviations.deviation_mm : std::vector<float>{},
                   run);
  measure_on_surface(plan,
                     {.mesh = &found.mesh,
                      .reference = reference == nullptr ? nullptr : &reference->scene,
                      .deviations = found.surface ? &*found.surface : nullptr,
                      .walls = found.walls ? &found.walls->thickness : nullptr,
                      .features = &found.named_features},
                     found.characteristics,
                     run);
  const SurfaceVerdict* surface = found.surface ? &found.surface->verdict : nullptr;
  found.verdict = verdict_of(surface, found.characteristics);
  found.reasons = verdict_reasons(surface, found.characteristics);
  return found;
}

}  // namespace

Inspection inspect_part(Mesh mesh,
                        const InspectionReference* reference,
                        const InspectionPlan& plan,
                        const InspectOptions& options,
                        const Run& run) {
  // The report states them, also where no terminal showed them.
  std::vector<std::string> warnings;
  Run kept = run;
  kept.on_warning = [&](const std::string& sentence) {
    if (std::find(warnings.begin(), warnings.end(), sentence) == warnings.end())
      warnings.push_back(sentence);
    run.warn(sentence);
  };
  Inspection found = inspected(std::move(mesh), reference, plan, options, kept);
  found.warnings = std::move(warnings);
  return found;
}

}  // namespace frangia
