#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Pairs of triangles that cross each other or lie on each other, beyond a corner or an edge that
/// they share; ascending, the lower number first. Triangles without area count not.
///
/// errors   Error(Input) when a triangle refers to a vertex that is not there, or in a build
///          without CGAL
/// source   CGAL, Intersecting Sequences of dD Iso-oriented Boxes; exact predicates
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(
    const Mesh& mesh, const Run& run = {});

/// The triangles that are in any such pair.
[[nodiscard]] Selection select_self_intersections(const Mesh& mesh, const Run& run = {});

}  // namespace frangia
