#pragma once

#include "frangia/files/internal/file_writer.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Writes the vertices interleaved, as binary PLY and PCD store them: position and normal (floats),
/// sigma and its parts (float), views (2 bytes), mark (1 byte). Attributes that the mesh does not
/// have are omitted.
void write_vertices(FileWriter& file, const Mesh& mesh);

}  // namespace frangia
