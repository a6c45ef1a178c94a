#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Puts back the edges and corners of the object that sampling cut off, in place.
///
/// A pixel that straddles an edge sees a mean of both faces, and cells are no smaller than pixels:
/// edges come out as chamfers up to about a voxel wide. The faces beside them are known, and are
/// carried on: vertices on a chamfer go to the face they belong to, or to the edge where they are
/// near it, and triangles that span two faces get vertices where the faces meet. What is rounder
/// than a voxel stays as it is, and so do folds too short to be an edge, and what would fold a
/// triangle over.
///
/// Returns for each vertex 1 on an edge of the object, 2 on a corner, else 0.
/// shape    a mesh with normals, sigma and views; `voxel_mm` is the distance of its vertices
/// source   Attene, Falcidieno, Rossignac & Spagnuolo 2005 (Sharpen & Bend)
std::vector<std::uint8_t> sharpen_edges(Mesh& mesh, float voxel_mm);

}  // namespace frangia
