#pragma once

#include <optional>

#include "frangia/inspect/inspect_surface.h"

#include "inspect_arguments.h"
#include "inspect_reference.h"

namespace frangia {

struct InspectedPart;

/// Measures the deviations of the aligned mesh from its reference.
[[nodiscard]] SurfaceInspection compare_with(const InspectArguments& arguments,
                                             const Mesh& mesh,
                                             const Reference& reference,
                                             const std::optional<Alignment>& alignment,
                                             const Run& run);

/// Adds `deviation`.
void add_deviations(InspectAnswer& answer, const SurfaceInspection& comparison);

/// Adds the statistics of all vertices, the completeness and the validity.
void add_statistics(InspectAnswer& answer,
                    const InspectArguments& arguments,
                    const Mesh& mesh,
                    const Reference& reference,
                    const Run& run);

/// The largest deviation on a color scale: that of the arguments, or 1.5 times the tolerance.
[[nodiscard]] double scale_mm(const InspectArguments& arguments, const ToleranceLimits& limits);

/// Writes the aligned mesh: as PLY with `deviation_mm` and `u_mm`, and with `thickness_mm` and
/// `thickness_u_mm`, as far as they were measured; as CSV one line for each compared vertex; in
/// formats with colors with those of the deviation.
void write_deviations(const std::filesystem::path& path,
                      const InspectArguments& arguments,
                      const InspectedPart& part,
                      const Run& run);

/// Checks before the work that a path can be written by `write_deviations`.
void check_deviation_output(const std::filesystem::path& path);

}  // namespace frangia
