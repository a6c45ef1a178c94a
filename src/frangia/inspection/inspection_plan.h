#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "frangia/align/align_points.h"
#include "frangia/core/enum_names.h"
#include "frangia/features/geometric_tolerance.h"
#include "frangia/features/shape.h"
#include "frangia/inspect/surface_verdict.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// How a part is put on its reference: by its shape, by datums, by pairs of points, or not at all.
inline constexpr std::array<std::string_view, 4> kAlignments{"best-fit", "datum", "points", "none"};

/// A feature that a plan names, and how it is recognized among those that were found.
struct PlannedFeature {
  std::string name;                                   ///< unique in the plan
  ShapeKind kind = ShapeKind::Plane;                  ///< of the feature
  Eigen::Vector3d near_mm = Eigen::Vector3d::Zero();  ///< near its center, frame of the reference
  std::size_t face = 0;                               ///< of the CAD reference, from 1; 0: none
  std::optional<double> diameter_mm;                  ///< nominal
  std::optional<ToleranceLimits> tolerance_mm;        ///< of the difference from the nominal
  std::map<Characteristic, double> forms_mm;          ///< upper limits of its own form
  FormReference form = FormReference::LeastSquares;   ///< of its own form: `fit`
};

/// A characteristic that a plan asks for, such as a distance or a run-out.
struct PlannedCharacteristic {
  std::string name;                                ///< unique in the plan
  Characteristic kind = Characteristic::Distance;  ///< what is measured
  /// Name of the feature; empty for a line profile, and for a surface profile or a thickness of the
  /// whole part.
  std::string feature;
  std::string section;                                    ///< name of the section of a line profile
  std::string datum;                                      ///< name of the datum; may be empty
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< true position, of `Position`
  std::optional<double> nominal;                          ///< of a distance, angle or thickness
  std::optional<ToleranceLimits> tolerance;               ///< of the difference from the nominal
  std::optional<double> limit;                            ///< upper limit of the other kinds
};

/// A section that a plan asks for.
struct PlannedSection {
  std::string name;                                    ///< unique in the plan
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< of the plane
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< of the plane, unit
  bool blade = false;                                  ///< measure it as the profile of a blade
};

/// The languages of a report: English, German, Italian.
inline constexpr std::array<std::string_view, 3> kReportLanguages{"en", "de", "it"};

/// Part of a report after its first sheet, in the order in which they are printed.
enum class ReportPage {
  Results,    ///< the whole table, where the first sheet has no room for it
  Pictures,   ///< of deviations and thickness, besides that of the first sheet
  Places,     ///< that are out or undecided
  Thickness,  ///< of the walls
  Sections,   ///< with those of blades
  Features,   ///< that were found
  Annex       ///< decision in detail, uncertainty, alignment, checksums, warnings
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(ReportPage /*any*/) {
  return EnumNames<ReportPage, 7>{{{ReportPage::Results, "results"},
                                   {ReportPage::Pictures, "pictures"},
                                   {ReportPage::Places, "places"},
                                   {ReportPage::Thickness, "thickness"},
                                   {ReportPage::Sections, "sections"},
                                   {ReportPage::Features, "features"},
                                   {ReportPage::Annex, "annex"}}};
}

/// What stands at the head of a report and which pages follow: `[report]`. Empty texts are left
/// out.
struct ReportFields {
  std::string drawing;          ///< number and revision
  std::string order;            ///< number
  std::string serial;           ///< of the part
  std::string customer;         ///< name
  std::string inspector;        ///< name of the operator
  std::string date;             ///< of the inspection; empty: when the report is written
  std::string paper = "A4";     ///< A4 or Letter
  std::string language = "en";  ///< one of `kReportLanguages`
  std::filesystem::path logo;   ///< PNG or JPEG, relative to the file of the plan; may be empty
  std::optional<std::vector<ReportPage>> pages{};  ///< after the first sheet; none: all

  /// Whether a part of the report is printed.
  [[nodiscard]] bool prints(ReportPage page) const;
};

/// How the parts of one kind are inspected: inspection.toml.
struct InspectionPlan {
  std::filesystem::path file;       ///< that it was read from; empty: none
  std::string part;                 ///< name of the part
  std::filesystem::path reference;  ///< relative to the file of the plan; may be empty
  std::optional<double> unit_mm;    ///< of the reference: `units`; none: not stated
  std::string align;                ///< one of `kAlignments`, or empty
  std::vector<std::string> datums;  ///< names of features, in their order; of `datum`
  /// The same places on scan and reference: the pose of `points`, and where the search of the
  /// others begins.
  std::vector<PointPair> points;
  std::size_t start = 0;                               ///< of poses that fit alike; 0: none
  std::optional<ToleranceLimits> tolerance_mm;         ///< of the deviations from the reference
  SurfaceRule surface;                                 ///< how they are decided; `limits` is unused
  bool thickness = false;                              ///< measure the thickness of the walls
  double expansion_ppm_per_k = 0.0;                    ///< coefficient of thermal expansion, 1e-6/K
  double temperature_u_k = 0.0;                        ///< standard uncertainty of the temperature
  std::vector<PlannedFeature> features;                ///< `[[features]]`
  std::vector<PlannedCharacteristic> characteristics;  ///< `[[characteristics]]`
  std::vector<PlannedSection> sections;                ///< `[[sections]]`
  ReportFields report;                                 ///< `[report]`

  /// The tolerance of the deviations; plus and minus 0.1 mm where none is stated.
  [[nodiscard]] ToleranceLimits tolerance() const;
  /// The deviation that still counts as overlap; 0: chosen by the size of the reference.
  [[nodiscard]] double overlap_tolerance_mm() const;
  /// Its file, for messages.
  [[nodiscard]] std::filesystem::path name() const;
};

/// Reads inspection.toml, format "frangia-inspection".
///
/// @units    mm and degrees, as the keys state
/// @errors   Error(Input) that names the file and the key, also one that is unknown
[[nodiscard]] InspectionPlan read_inspection_plan(const std::filesystem::path& path);

/// Reads the text of an inspection.toml; `path` is for messages and for what is relative to it.
///
/// @errors   as read_inspection_plan
[[nodiscard]] InspectionPlan parse_inspection_plan(const std::string& text,
                                                   const std::filesystem::path& path);

}  // namespace frangia
