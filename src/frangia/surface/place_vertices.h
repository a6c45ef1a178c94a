#pragma once

#include <span>

#include "frangia/surface/crossings.h"
#include "frangia/surface/evidence.h"
#include "frangia/surface/mesh.h"

namespace frangia {

/// One vertex for each loop of each cell, where the planes through the loop's crossings meet.
///
/// Planes that agree are averaged, planes that meet in an edge or a corner put the vertex there:
/// directions in which they say less than noise does are left at their middle.
/// shape    `crossings.vertices` vertices with normals, sigma and views; no triangles
/// missing  a vertex none of whose crossings holds is zero
/// source   dual contouring, Ju et al. 2002; several vertices a cell, Schaefer et al. 2007
[[nodiscard]] Mesh place_vertices(const Crossings& crossings, std::span<const Evidence> evidence);

}  // namespace frangia
