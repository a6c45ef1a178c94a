#pragma once

#include <span>

#include "frangia/files/internal/file_writer.h"
#include "frangia/files/ply.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// How a format stores the color of a vertex.
enum class ColorLayout {
  Bytes,  ///< red, green and blue, a byte each
  Packed  ///< four bytes: blue, green, red and zero
};

/// Writes the vertices interleaved, as binary PLY and PCD store them: position and normal (floats),
/// sigma and its parts (float), views (2 bytes), mark (1 byte), color, the rest (float). Attributes
/// that the mesh does not have are omitted.
void write_vertices(FileWriter& file,
                    const Mesh& mesh,
                    ColorLayout colors,
                    std::span<const VertexProperty> more = {});

}  // namespace frangia
