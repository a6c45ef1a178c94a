#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/report/inspection_report.h"

namespace frangia {

/// Where an inspection comes from, as its report states it. Empty paths are left out.
struct ReportSources {
  std::filesystem::path mesh;         ///< its file
  std::filesystem::path reference;    ///< its file
  std::string reference_name;         ///< for people; empty: that of its file
  const Scan* scan = nullptr;         ///< of the mesh; null: not known
  std::string version;                ///< of the software
  std::vector<std::string> warnings;  ///< of reading the files; the inspection has its own
  double scale_mm = 0.0;              ///< end of the color scales; 0: chosen
};

/// Gathers what a report of an inspection shows, and draws its pictures. The plan is the one by
/// which the part was inspected.
///
/// @errors   Error(File) for a source that cannot be read; Error(Input) for a logo that is no
///           picture; Error(Cancelled)
[[nodiscard]] InspectionReport report_of(const Inspection& part,
                                         const InspectionPlan& plan,
                                         const ReportSources& sources,
                                         const Run& run = {});

/// Writes the report of an inspection as one page of HTML and, in the same folder, its JSON, the
/// characteristics as CSV and each section as DXF and SVG. Returns the paths that were written, the
/// page last.
///
/// @errors   as report_of; Error(File) when a file cannot be written
std::vector<std::string> write_report(const std::filesystem::path& page,
                                      const Inspection& part,
                                      const InspectionPlan& plan,
                                      const ReportSources& sources,
                                      const Run& run = {});

}  // namespace frangia
