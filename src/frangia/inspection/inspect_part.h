#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/align/align_best_fit.h"
#include "frangia/align/align_datum.h"
#include "frangia/cad/nominal_face.h"
#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/features/find_features.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspect/inspect_surface.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/inspect/surface_validity.h"
#include "frangia/inspect/thickness.h"
#include "frangia/inspection/align_part.h"
#include "frangia/inspection/cut_sections.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/inspection/inspection_reference.h"
#include "frangia/inspection/measured_characteristics.h"
#include "frangia/inspection/verdict_reasons.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// What is inspected besides the plan.
struct InspectOptions {
  bool features = false;   ///< also where the plan names none: all that are found
  bool statistics = true;  ///< of all vertices against the reference: `SurfaceStatistics`
  double within_mm = 0.2;  ///< a point of the reference is covered by mesh within this distance
  /// A view can measure surfaces whose normal is within this angle of camera and projector.
  double max_angle_rad = rad_from_deg(75.0);
  /// The scan of the mesh: completeness counts what its views can measure, and features hold the
  /// covariance of its rig; null: not known.
  const Scan* scan = nullptr;
  std::filesystem::path mesh_name = "the mesh";  ///< for messages
};

/// What a reference is, for people.
struct ReferenceSummary {
  std::size_t triangles = 0;  ///< of the mesh or the tessellation
  bool is_cad = false;        ///< a STEP or IGES file, no mesh
  std::size_t faces = 0;      ///< of the CAD model
  std::string unit;           ///< of the CAD file in words
};

/// How all vertices of a mesh lie on its reference.
struct SurfaceStatistics {
  SurfaceError error;                ///< distances of the vertices from the reference
  SurfaceCompleteness completeness;  ///< share of the reference that has mesh
  SurfaceValidity validity;          ///< whether sigma predicts the errors
  double within_mm = 0.0;            ///< of `completeness`
  bool of_views = false;  ///< `completeness` counts what the views of the scan can measure
};

/// The thickness of the walls.
struct MeasuredWalls {
  Thickness thickness;       ///< of each vertex
  ThicknessSummary summary;  ///< of all of them
};

/// Everything that one inspection found. The program, the report, the app and Python format it.
struct Inspection {
  Mesh mesh;                                            ///< aligned
  std::optional<ReferenceSummary> reference;            ///< none: no reference
  std::optional<Alignment> alignment;                   ///< none: the plan says nothing about it
  std::vector<DatumResidual> datums;                    ///< of an alignment to datums
  std::vector<double> points_mm;                        ///< see `PartAlignment`
  bool searched = false;                                ///< features were looked for
  std::vector<Feature> features;                        ///< that were found
  std::vector<std::optional<NominalFace>> nominals;     ///< of the features, by a CAD reference
  std::vector<NamedFeature> named_features;             ///< those of the plan
  std::vector<MeasuredCharacteristic> characteristics;  ///< of the plan, in its order
  std::optional<SurfaceStatistics> statistics;          ///< none without a reference
  std::optional<SurfaceInspection> surface;    ///< deviations from the reference and the decision
  bool tolerance_is_default = false;           ///< the plan states none for the deviations
  std::optional<MeasuredWalls> walls;          ///< their thickness, where asked for
  std::vector<SectionResult> sections;         ///< of the plan, in its order
  bool knows_calibration = false;              ///< features hold the covariance of the rig
  Conformity verdict = Conformity::Undecided;  ///< about the part, by `verdict_of`
  std::vector<VerdictReason> reasons;          ///< of the verdict, what decided first
  std::vector<std::string> warnings;           ///< that were given, each once
};

/// Inspects a part by a plan: aligns its mesh to the reference, finds and measures features, judges
/// the deviations, measures walls and cuts sections.
///
/// `reference` is null where nothing is measured against; the plan's own `reference` and `unit_mm`
/// are not used here: the caller reads the reference by them. The same input gives the same bytes
/// with any number of threads.
/// @units    mm, degrees
/// @missing  NaN, and empty members for what was not asked for
/// @errors   Error(Input) as align_part, find_features, state_nominals and inspect_surface, and
///           for an alignment without a reference; Error(Numeric) when no part of the mesh can be
///           compared with the reference; Error(Cancelled)
/// @source   ISO 14253-1:2017 for the decisions
[[nodiscard]] Inspection inspect_part(Mesh mesh,
                                      const InspectionReference* reference,
                                      const InspectionPlan& plan,
                                      const InspectOptions& options = {},
                                      const Run& run = {});

}  // namespace frangia
