#pragma once

#include <filesystem>

#include "frangia/inspect/render_mesh.h"
#include "frangia/inspect/thickness.h"

#include "inspect_arguments.h"

namespace frangia {

/// The thickness of the walls as the report and the outputs need it.
struct MeasuredWalls {
  Thickness thickness;
  ThicknessSummary summary;
};

/// Measures the walls of the mesh.
[[nodiscard]] MeasuredWalls measure_walls(const Mesh& mesh, const Run& run);

/// Adds `thickness`.
void add_thickness(InspectAnswer& answer, const MeasuredWalls& walls);

/// Options of a picture of the thickness, with its histogram.
[[nodiscard]] RenderOptions thickness_picture(const InspectArguments& arguments,
                                              const Mesh& mesh,
                                              const MeasuredWalls& walls);

}  // namespace frangia
