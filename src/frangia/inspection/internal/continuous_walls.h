#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"
#include "frangia/inspect/thickness.h"

namespace frangia::inspection {

/// The vertices of each wall: connected ones between which the thickness changes no more than the
/// walls can be inclined to each other. Where a face ends above another wall, it jumps, and a
/// function fitted across the jump is the thickness of neither.
///
/// @shape    `counts`: of each vertex, whether it is asked for; such with a thickness
[[nodiscard]] std::vector<std::vector<std::uint32_t>> continuous_walls(
    const Mesh& mesh, const Thickness& walls, const std::vector<bool>& counts);

}  // namespace frangia::inspection
