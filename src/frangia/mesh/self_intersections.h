#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Finds the pairs of triangles that intersect or overlap beyond a vertex or an edge that they
/// share. Triangles without area are ignored.
///
/// @shape    pairs of triangle indices, the smaller one first, in ascending order
/// @errors   Error(Input) when a triangle refers to a vertex that does not exist, when more than
///          a million pairs intersect, or in a build without CGAL; Error(Cancelled)
/// @source   CGAL, Intersecting Sequences of dD Iso-oriented Boxes; exact predicates
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(
    const Mesh& mesh, const Run& run = {});

/// Selects the triangles of all such pairs.
[[nodiscard]] Selection select_self_intersections(const Mesh& mesh, const Run& run = {});

/// Removes self-intersections. The mesh away from them is unchanged.
///
/// Closed components that intersect each other are united. Elsewhere the intersecting triangles are
/// removed, together with pieces that this cuts off if they hold less than a tenth of the area of
/// their component, and the new holes are filled and marked as synthesized. This repeats with one
/// more ring of triangles each time until no intersection is left. Existing boundaries stay open.
///
/// @errors   Error(Input) as self_intersections; Error(Cancelled)
[[nodiscard]] Mesh remove_self_intersections(Mesh mesh, const Run& run = {});

}  // namespace frangia
