#pragma once

#include <filesystem>
#include <vector>

#include "frangia/align/align_best_fit.h"
#include "frangia/align/align_datum.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/inspection/inspection_reference.h"

namespace frangia {

/// The pose of a part on its reference, and how far each datum is from its nominal place then.
struct PartAlignment {
  Alignment alignment;                ///< of the mesh to the reference
  std::vector<DatumResidual> datums;  ///< empty for another alignment than `datum`
  /// Of each pair of points of the plan, how far its points are apart in the pose.
  std::vector<double> points_mm;
};

/// Finds the pose that a plan asks for: `best-fit`, from any start or from its pairs of points;
/// `datum`, by the datums of the plan; `points`, by the pairs alone; otherwise as the mesh stands.
///
/// For datums, a best fit brings the mesh near, where they are looked for on it; their nominal
/// places are the faces of a CAD reference that the plan names, or the same features of the
/// reference. `mesh_name` is for messages.
/// @errors   Error(Input) that names a datum which is not found; as align_best_fit,
/// align_to_datums,
///           align_to_points and state_nominals
[[nodiscard]] PartAlignment align_part(const Mesh& mesh,
                                       const InspectionReference& reference,
                                       const InspectionPlan& plan,
                                       const std::filesystem::path& mesh_name,
                                       const Run& run = {});

/// The features of a plan with what the faces of a CAD reference state of them.
///
/// @errors   Error(Input) as state_nominals and check_without_cad
[[nodiscard]] std::vector<PlannedFeature> stated_features(const InspectionPlan& plan,
                                                          const InspectionReference* reference);

}  // namespace frangia
