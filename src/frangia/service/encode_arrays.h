#pragma once

#include <span>
#include <string>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Packs a mesh for a browser: the number of bytes of a JSON header (uint32), the header, then its
/// arrays. All numbers are little-endian; every array begins at a multiple of 4 bytes.
///
/// The header is {"arrays": [{"name": "positions", "type": "float32", "length": 9, "offset": 128},
/// ...]} with offsets from the beginning. Arrays: `positions` (x, y, z of each vertex, mm),
/// `triangles` (uint32), and where the mesh has them `normals`, `sigma_mm`, `views` (uint16) and
/// `marks` (uint8, one for each triangle, as Mark). The header holds {"revision": R} as "values".
[[nodiscard]] std::string encode_mesh(const Mesh& mesh, int revision);

/// Packs a selection in the same form: `selected` (uint8, one for each triangle). It is empty when
/// nothing is selected. The header holds {"revision": R} as "values".
[[nodiscard]] std::string encode_selection(const Selection& selection, int revision);

/// Packs points in the same form: `positions` and `sigma_mm`. Of more than `most` points, each k-th
/// is kept.
[[nodiscard]] std::string encode_points(const PointCloud& points, std::size_t most);

}  // namespace frangia
