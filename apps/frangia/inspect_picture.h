#pragma once

#include <optional>

#include "inspect_arguments.h"
#include "inspect_comparison.h"
#include "inspect_report.h"

namespace frangia {

/// Checks before the work that the mesh has what --show names.
void check_shown(const InspectArguments& arguments, const Mesh& mesh);

/// Options of a picture of the deviations, with the tolerance band and the histogram.
[[nodiscard]] RenderOptions deviation_picture(const InspectArguments& arguments,
                                              const Mesh& mesh,
                                              const SurfaceInspection& comparison);

/// Draws the picture that the arguments ask for.
void draw_picture(const InspectArguments& arguments, const InspectedPart& part, const Run& run);

}  // namespace frangia
