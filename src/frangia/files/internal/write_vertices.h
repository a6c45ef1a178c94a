#pragma once

#include "frangia/files/internal/file_writer.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// All that a mesh knows of its vertices, one after the other as PLY and PCD have it: place and
/// normal as floats, sigma as a float, views in two bytes, the mark in one; what it does not know
/// is left out.
void write_vertices(FileWriter& file, const Mesh& mesh);

}  // namespace frangia
