#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/report/inspection_report.h"

#include "inspect_arguments.h"
#include "inspect_comparison.h"
#include "inspect_thickness.h"

namespace frangia {

/// What one inspection found, as the report needs it.
struct InspectedPart {
  Mesh mesh;                                    ///< aligned
  std::optional<Alignment> alignment;           ///< of the mesh on the reference
  std::optional<SurfaceInspection> comparison;  ///< with the reference
  std::optional<MeasuredWalls> walls;           ///< their thickness
  Eigen::MatrixXf shared_mm;                    ///< `calibration_mm` of `FeaturePoints`; or empty
  bool knows_calibration = false;               ///< it holds the covariance of the rig
  std::vector<Feature> features;                ///< that were found
  std::vector<std::optional<NominalFace>> nominals;  ///< of the features, by a CAD reference
  std::vector<MeasuredCharacteristic> characteristics;
  std::vector<NamedFeature> named_features;  ///< those of the plan
  std::vector<SectionResult> sections;
};

/// Cuts the mesh and its reference by the planes of a plan.
[[nodiscard]] std::vector<SectionResult> cut_sections(
    const InspectionPlan& plan,
    const Mesh& mesh,
    const RayScene* reference,
    const std::optional<SurfaceInspection>& comparison,
    const Run& run);

/// Adds `characteristics` and `sections`.
void add_results(InspectAnswer& answer, const InspectedPart& part);

/// Writes the report, and in the same folder the JSON, the characteristics as CSV and each section
/// as DXF and SVG. Returns the paths that were written.
[[nodiscard]] std::vector<std::string> write_report(const InspectArguments& arguments,
                                                    const InspectionPlan& plan,
                                                    const InspectedPart& part,
                                                    const InspectAnswer& answer,
                                                    const std::vector<std::string>& warnings,
                                                    const Run& run);

}  // namespace frangia
