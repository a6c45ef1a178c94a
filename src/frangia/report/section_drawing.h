#pragma once

#include <string>

#include "frangia/inspection/cut_sections.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// Draws a section as SVG: the reference in black, the measured curves in blue, and whiskers along
/// the deviations, enlarged so that the largest is a tenth of the size.
///
/// @errors   Error(Input) for a section without curves
[[nodiscard]] std::string svg_of(const SectionResult& section, int width_px = 540);

/// Draws the deviation of the longest measured curve over its length as SVG.
///
/// @missing  empty without a reference
[[nodiscard]] std::string profile_plot(const SectionResult& section,
                                       const ToleranceLimits& limits,
                                       int width_px = 540);

/// Returns a section as a text DXF of release 12: polylines in the coordinates of the plane on the
/// layers MEASURED and REFERENCE.
///
/// @units    mm
[[nodiscard]] std::string dxf_of(const SectionResult& section);

}  // namespace frangia
