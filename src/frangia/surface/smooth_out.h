#pragma once

#include <cstdint>
#include <span>

#include "frangia/surface/mesh.h"

namespace frangia {

/// Takes slivers and caps away, in place: what is lower than `lowest_mm`, edges shorter than twice
/// that.
///
/// shape    `sharp`: see `collapse_slivers`
void smooth_out(Mesh& mesh, std::span<const std::uint8_t> sharp, float lowest_mm);

}  // namespace frangia
