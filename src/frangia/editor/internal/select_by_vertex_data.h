#pragma once

#include <functional>
#include <vector>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Selects the triangles with a vertex whose sigma is larger.
///
/// @missing  a vertex without a sigma counts as larger
/// @errors   Error(Input) when the mesh has no sigma
[[nodiscard]] Selection select_by_sigma(const Mesh& mesh, double above_mm);

/// Selects the triangles with a vertex that fewer views measured.
///
/// @errors   Error(Input) when the mesh has no view counts
[[nodiscard]] Selection select_by_views(const Mesh& mesh, int fewer_than);

/// Selects the triangles with this mark.
[[nodiscard]] Selection select_by_mark(const Mesh& mesh, Mark mark);

/// Selects the triangles with a vertex whose mean curvature is larger in magnitude.
[[nodiscard]] Selection select_by_curvature(const Mesh& mesh, double above_per_mm);

/// The mean curvature at each vertex, positive where the surface is convex seen from outside.
///
/// @shape    one per vertex
/// @units    1/mm; 1/r on a sphere of radius r
/// @missing  NaN at boundaries and at vertices without area
/// @source   Meyer, Desbrun, Schroeder & Barr 2003, Discrete Differential-Geometry Operators
[[nodiscard]] std::vector<float> mean_curvature_per_mm(const Mesh& mesh);

}  // namespace frangia
