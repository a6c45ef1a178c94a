#pragma once

#include <cstdint>
#include <span>

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Removes triangles lower than `lowest_mm` and edges shorter than twice that, in place.
///
/// @shape    `sharp`: see `collapse_slivers`
void remove_slivers(Mesh& mesh,
                    std::span<const std::uint8_t> sharp,
                    float lowest_mm,
                    const CleanupParameters& parameters = {});

}  // namespace frangia
