#pragma once

#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/inspect_surface.h"
#include "frangia/inspect/thickness.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/inspection/measured_characteristics.h"

namespace frangia {

/// What profiles and thicknesses are measured on.
struct InspectedSurface {
  const Mesh* mesh = nullptr;                           ///< aligned
  const RayScene* reference = nullptr;                  ///< null: none
  const SurfaceInspection* deviations = nullptr;        ///< from the reference; null: none
  const Thickness* walls = nullptr;                     ///< of the mesh; null: not measured
  const std::vector<NamedFeature>* features = nullptr;  ///< of the plan, that were found
};

/// Whether a plan asks for the thickness of walls: by itself or by a characteristic.
[[nodiscard]] bool needs_walls(const InspectionPlan& plan);

/// Measures the characteristics of a plan that are `is_of_surface`, and decides about them. `rows`
/// are those of `measure_characteristics`.
///
/// A profile is twice the largest deviation of a patch of the nominal surface: the width of the
/// zone about it that holds all patches, of the whole judged surface, of those that lie on a
/// feature, or of those that a section cuts. It is decided as the surface is, by the same rule. A
/// thickness is the one that is farthest from its nominal value, or the least where none is stated,
/// without noise as a form is. The surface of a feature is all of it, and not only what lies on its
/// shape.
///
/// `run` is warned of what cannot be measured.
/// @units    mm
/// @missing  the value of what was not measured is NaN
/// @errors   Error(Input) for a profile without a reference
void measure_on_surface(const InspectionPlan& plan,
                        const InspectedSurface& surface,
                        std::vector<MeasuredCharacteristic>& rows,
                        const Run& run = {});

}  // namespace frangia
