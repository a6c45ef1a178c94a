#include "inspect_mesh.h"

#include <utility>
#include <vector>

#include "frangia/calibrate/solve/calibration_displacements.h"
#include "frangia/features/find_features.h"
#include "frangia/features/thermal_displacement.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/report/planned_nominals.h"

#include "inspect_alignment.h"
#include "inspect_comparison.h"
#include "inspect_datums.h"
#include "inspect_features.h"
#include "inspect_picture.h"
#include "inspect_thickness.h"
#include "option_names.h"
#include "read_surface.h"

namespace frangia {
namespace {

constexpr const char* kDefaultTolerance =
    "the tolerance is the default, because none is stated: set `tolerance`, or tolerance_mm of a "
    "plan\n";

/// Finds what moves all features alike: the calibration of the rig and the temperature. The mesh
/// still has the frame of its scan.
void add_shared_errors(const InspectArguments& arguments, InspectedPart& part, const Run& run) {
  constexpr double kPerMillion = 1e-6;
  if (!arguments.scan.empty()) {
    part.shared_mm = calibration_displacements(part.mesh, read_scan(arguments.scan, run), run);
    part.knows_calibration = part.shared_mm.size() > 0;
  }
  if (!(arguments.expansion_ppm_per_k * arguments.temperature_u_k > 0.0)) return;
  const Eigen::MatrixXf thermal = thermal_displacement(
      part.mesh, kPerMillion * arguments.expansion_ppm_per_k, arguments.temperature_u_k);
  part.shared_mm.conservativeResize(part.shared_mm.rows() + 1, thermal.cols());
  part.shared_mm.bottomRows(1) = thermal;
}

/// Finds the features of the mesh and measures those of the plan.
void inspect_features(const InspectArguments& arguments,
                      InspectionPlan plan,
                      const std::optional<Reference>& reference,
                      InspectedPart& part,
                      InspectAnswer& answer,
                      const Run& run) {
  if (reference && reference->cad) {
    state_nominals(plan.features, reference->cad->faces(), arguments.plan);
  } else {
    check_without_cad(plan.features, arguments.plan);
  }
  if (!arguments.features && plan.features.empty()) return;
  run.stage("features");
  part.features = find_features(part.mesh, {.calibration_mm = &part.shared_mm}, run);
  std::vector<MeasuredFeature> measured;
  if (!plan.features.empty() || (reference && reference->cad))
    measured = with_points(part.mesh, part.features, run);
  if (reference) part.nominals = nominal_faces(*reference, measured);
  add_features(answer.json, part.features, part.nominals);
  if (arguments.features) answer.text += feature_table(part.features, part.nominals);
  if (plan.features.empty()) return;
  part.characteristics = measure_characteristics(plan, measured, run);
  part.named_features = named_features(plan, measured);
}

}  // namespace

InspectedPart inspect_mesh(const InspectArguments& arguments,
                           const InspectionPlan& plan,
                           const std::optional<Reference>& reference,
                           InspectAnswer& answer,
                           const Run& run) {
  InspectedPart part;
  part.mesh = read_surface(arguments.mesh, run, arguments.read);
  if (!arguments.picture.empty()) check_shown(arguments, part.mesh);
  if (arguments.features || !plan.features.empty()) add_shared_errors(arguments, part, run);
  if (reference) add_reference(answer, *reference);
  const std::string& how = arguments.alignment.align;
  if (reference && (how.empty() || how == "none")) {
    const BestFitOptions options{.reference_unit_mm = arguments.alignment.unit_mm.value_or(1.0)};
    refuse_unit_of_pose(part.mesh, reference->scene, Eigen::Isometry3d::Identity(), options, run);
  }
  if (!how.empty()) {
    DatumFit fit;
    if (how == "datum") {
      fit = align_by_datums(arguments, plan, part.mesh, *reference, run);
    } else {
      fit.alignment = align(part.mesh, reference->scene, arguments.alignment, run);
    }
    part.alignment = std::move(fit.alignment);
    add_alignment(answer.json, *part.alignment);
    answer.text += alignment_text(*part.alignment);
    if (!fit.residuals.empty()) add_datums(answer.json, fit.residuals);
    answer.text += datum_text(fit.residuals);
    part.mesh = transform_mesh(std::move(part.mesh), part.alignment->pose.reference_from_mesh);
  }
  inspect_features(arguments, plan, reference, part, answer, run);
  if (reference) {
    part.comparison = compare_with(arguments, part.mesh, *reference, part.alignment, run);
    add_statistics(answer, arguments, part.mesh, *reference, run);
    add_deviations(answer, *part.comparison);
    answer.json["deviation"]["tolerance_is_default"] = arguments.alignment.tolerance_mm.empty();
    if (arguments.alignment.tolerance_mm.empty()) answer.text += with_flags(kDefaultTolerance);
  }
  if (arguments.thickness) {
    part.walls = measure_walls(part.mesh, run);
    add_thickness(answer, *part.walls);
  }
  part.sections =
      cut_sections(plan, part.mesh, reference ? &reference->scene : nullptr, part.comparison, run);
  add_results(answer, part);
  return part;
}

}  // namespace frangia
