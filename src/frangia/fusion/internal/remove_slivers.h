#pragma once

#include <cstdint>
#include <span>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Takes slivers and caps away, in place: what is lower than `lowest_mm`, edges shorter than twice
/// that.
///
/// shape    `sharp`: see `collapse_slivers`
void remove_slivers(Mesh& mesh, std::span<const std::uint8_t> sharp, float lowest_mm);

}  // namespace frangia
