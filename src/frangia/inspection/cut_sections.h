#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspect/blade_section.h"
#include "frangia/inspect/section_curves.h"
#include "frangia/inspection/inspection_plan.h"

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

/// Cuts an aligned mesh and its reference by the planes of a plan. `deviation_mm` is that of each
/// vertex; empty, like a `reference` that is null: not known.
///
/// `run` is warned of a section that is to be measured as a blade and is none.
/// @units    mm
[[nodiscard]] std::vector<SectionResult> cut_sections(const std::vector<PlannedSection>& planned,
                                                      const Mesh& mesh,
                                                      const Mesh* reference,
                                                      const std::vector<float>& deviation_mm,
                                                      const Run& run = {});

}  // namespace frangia
