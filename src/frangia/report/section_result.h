#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/inspect/blade_section.h"
#include "frangia/inspect/section_curves.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// A section of the measured part and of its reference by one plane.
struct SectionResult {
  std::string name;                     ///< of the plan
  SectionPlane plane;                   ///< in the frame of the reference
  std::vector<SectionCurve> measured;   ///< with deviations as values, if a reference is known
  std::vector<SectionCurve> reference;  ///< empty without one
  std::optional<BladeSection> blade;    ///< of the measured curve, where asked for
  std::optional<BladeSection> nominal_blade;  ///< of the reference
};

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
