#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/phase/algorithm/linear_algorithm.h"

namespace frangia {

/// Reads a phase-shift algorithm of the user:
///
///     format = "frangia-algorithm"
///     version = 1
///     name = "mine"
///     shifts_deg = [0, 90, 180, 270]
///     numerator = [0, -1, 0, 1]          # phase = atan2(numerator . frames, denominator . frames)
///     denominator = [1, 0, -1, 0]
///
/// @errors   Error(Input) that names the file and the key, and as `linear_algorithm`
[[nodiscard]] LinearAlgorithm read_algorithm(const std::filesystem::path& path,
                                             const Run& run = {});

}  // namespace frangia
