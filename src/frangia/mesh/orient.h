#pragma once

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The mesh with neighbours wound the same way round, and closed parts facing outwards.
///
/// An open part keeps the side that the larger share of its area had. A part that has but one side
/// (a Moebius strip) stays wound against itself along some edges.
[[nodiscard]] Mesh orient(Mesh mesh);

/// Every triangle and normal turned to the other side.
[[nodiscard]] Mesh reverse_orientation(Mesh mesh);

}  // namespace frangia
