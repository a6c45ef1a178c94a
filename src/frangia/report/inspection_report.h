#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frangia/cad/nominal_face.h"
#include "frangia/features/find_features.h"
#include "frangia/inspect/deviation.h"
#include "frangia/inspect/surface_verdict.h"
#include "frangia/inspect/thickness.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/inspection/measured_characteristics.h"
#include "frangia/report/labelled_picture.h"
#include "frangia/report/report_pictures.h"
#include "frangia/report/report_words.h"
#include "frangia/report/section_drawing.h"

namespace frangia {

/// Everything that the report of one inspection shows. Parts that are empty are left out.
struct InspectionReport {
  std::string part;                ///< name of the part; may be empty
  ReportFields fields;             ///< of the plan
  std::optional<ReportLogo> logo;  ///< that `fields` names
  std::string mesh;                ///< name of the file of the mesh
  std::string reference;           ///< name of the file that it was compared with; empty: none
  std::string created;             ///< date and time
  std::string version;             ///< of the software
  /// Further facts, each with its name: files, checksums, rig, date of the calibration.
  std::vector<std::pair<std::string, std::string>> conditions;
  std::vector<std::pair<std::string, std::string>> alignment;  ///< as `conditions`
  std::optional<DeviationSummary> deviation;                   ///< from the reference, unfiltered
  std::optional<SurfaceVerdict> surface;                       ///< with `deviation`
  std::optional<ThicknessSummary> thickness;                   ///< of the walls
  std::vector<ReportPicture> pictures;  ///< of deviations and thickness, the largest first
  std::vector<MeasuredCharacteristic> characteristics;  ///< that a plan asked for
  std::vector<Feature> features;  ///< surfaces that were found, and edges that the plan names
  std::vector<std::string> feature_names;       ///< of the plan; empty for none of its
  std::vector<ReportPicture> feature_pictures;  ///< with their numbers
  /// The face of the CAD reference of each feature; empty without such a reference.
  std::vector<std::optional<NominalFace>> nominals;
  std::vector<SectionResult> sections;  ///< that a plan asked for
  /// Of each section the sizes that it shows; or empty.
  std::vector<std::vector<SectionDimension>> dimensions;
  /// Largest or typical standard uncertainty of each known source, mm.
  std::vector<std::pair<std::string, double>> uncertainty_mm;
  bool systematic_known = false;      ///< the mesh states a systematic part of sigma
  bool correlation_known = false;     ///< features hold the covariance of the rig's parameters
  std::vector<std::string> warnings;  ///< of the inspection
};

/// The decision about the part: out when the deviations or a characteristic are out, in when all
/// are in.
[[nodiscard]] Conformity verdict_of(const InspectionReport& report);

/// Why the verdict is what it is, the most important sentence first.
[[nodiscard]] std::vector<std::string> reasons_of(const InspectionReport& report,
                                                  const ReportWords& words = ReportWords());

/// Returns the report in the language of its fields as one page of HTML without references to other
/// files: first a sheet with the verdict, the first picture and the worst rows of the table; then
/// the rest of the table, pictures, sections and features; calibration, uncertainty and checksums
/// as an annex.
[[nodiscard]] std::string html_of(const InspectionReport& report);

/// Returns the characteristics as CSV with the header
/// `name,unit,nominal,lower,upper,value,u95,conformity`.
[[nodiscard]] std::string csv_of(const std::vector<MeasuredCharacteristic>& rows);

}  // namespace frangia
