#pragma once

#include <optional>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The outer surface of two closed bodies that cross: what of each lies inside the other is gone,
/// and the rest is joined along the curves where they meet.
///
/// Vertices that stay keep their places and all that is known of them; along the curves it is taken
/// from the nearest place. Nothing when either is not closed or crosses itself, or in a build
/// without CGAL.
/// source   CGAL, Polygon Mesh Processing: corefinement and Boolean operations
[[nodiscard]] std::optional<Mesh> unite_bodies(const Mesh& a, const Mesh& b);

}  // namespace frangia
