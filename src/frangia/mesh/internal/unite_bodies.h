#pragma once

#include <optional>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Computes the union of two closed bodies: the parts of each inside the other are removed, and the
/// rest is joined along the intersection curves.
///
/// Vertices that remain keep their position and data; new vertices on the intersection curves take
/// the data of the nearest point.
///
/// @missing  nullopt when a body is not closed or intersects itself, or in a build without CGAL
/// @errors   Error(Cancelled)
/// @source   CGAL, Polygon Mesh Processing: corefinement and Boolean operations
[[nodiscard]] std::optional<Mesh> unite_bodies(const Mesh& a, const Mesh& b, const Run& run = {});

}  // namespace frangia
