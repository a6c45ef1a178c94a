#pragma once

#include <string>

#include "frangia/inspection/cut_sections.h"
#include "frangia/report/report_words.h"
#include "frangia/report/section_dimensions.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// Draws a section as SVG: the reference in black, the measured curves in blue, and whiskers along
/// the deviations, enlarged so that the largest is a tenth of the size, and the measured sizes that
/// it shows.
///
/// @errors   Error(Input) for a section without curves
[[nodiscard]] std::string svg_of(const SectionResult& section,
                                 const std::vector<SectionDimension>& dimensions = {},
                                 const ReportWords& words = ReportWords());

/// Draws the deviation of the longest measured curve over its length as SVG.
///
/// @missing  empty without a reference
[[nodiscard]] std::string profile_plot(const SectionResult& section,
                                       const ToleranceLimits& limits,
                                       const ReportWords& words = ReportWords());

/// Returns a section as a text DXF of release 12: polylines in the coordinates of the plane on the
/// layers MEASURED and REFERENCE.
///
/// @units    mm
[[nodiscard]] std::string dxf_of(const SectionResult& section);

}  // namespace frangia
