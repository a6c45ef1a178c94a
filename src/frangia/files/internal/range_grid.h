#pragma once

#include <filesystem>
#include <string_view>

#include "frangia/files/internal/ply_header.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Whether a PLY is a range scan of Stanford: its points are named by the cells of a grid.
[[nodiscard]] bool has_range_grid(const PlyHeader& header);

/// Adds the triangles between neighbours in the grid of a range scan, which face +z. `bytes` are
/// the whole file.
///
/// @missing  empty cells; no triangle has an edge longer than six times the median spacing of
///           neighbours
/// @errors   Error(Input) that names the file: the grid does not match its stated size or the
/// points
void add_grid_triangles(Mesh& mesh,
                        const PlyHeader& header,
                        std::string_view bytes,
                        const std::filesystem::path& path);

}  // namespace frangia
