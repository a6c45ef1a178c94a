#pragma once

#include <functional>
#include <vector>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// The triangles of which a vertex has a sigma above this, or none.
///
/// errors   Error(Input) when the mesh has no sigma
[[nodiscard]] Selection select_by_sigma(const Mesh& mesh, double above_mm);

/// The triangles of which a vertex was seen by fewer views than this.
///
/// errors   Error(Input) when the mesh has no counts of views
[[nodiscard]] Selection select_by_views(const Mesh& mesh, int fewer_than);

/// The triangles whose mark is this one.
[[nodiscard]] Selection select_by_mark(const Mesh& mesh, Mark mark);

/// The triangles of which a vertex is curved more than this, either way.
[[nodiscard]] Selection select_by_curvature(const Mesh& mesh, double above_per_mm);

/// Half the sum of the two principal curvatures at each vertex, positive where the surface bulges
/// outwards.
///
/// shape    one a vertex
/// units    1/mm; a sphere of radius r has 1/r
/// missing  NaN at boundaries and at vertices without area
/// source   Meyer, Desbrun, Schroeder & Barr 2003, Discrete Differential-Geometry Operators
[[nodiscard]] std::vector<float> mean_curvature_per_mm(const Mesh& mesh);

}  // namespace frangia
