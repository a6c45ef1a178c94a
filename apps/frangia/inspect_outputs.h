#pragma once

#include <filesystem>

#include "frangia/inspection/inspect_part.h"

namespace frangia {

/// Writes the aligned mesh: as PLY with `deviation_mm` and `u_mm`, and with `thickness_mm` and
/// `thickness_u_mm`, as far as they were measured; as CSV one line for each compared vertex; in
/// formats with colors with those of the deviation, whose scale ends at `scale_mm`; 0: chosen.
void write_deviations(const std::filesystem::path& path,
                      const Inspection& part,
                      double scale_mm,
                      const Run& run);

/// Checks before the work that a path can be written by `write_deviations`.
void check_deviation_output(const std::filesystem::path& path);

}  // namespace frangia
