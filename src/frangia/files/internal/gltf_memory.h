#pragma once

#include <cstdint>
#include <vector>

#include "frangia/files/internal/gltf_document.h"

namespace frangia {

/// The `mode` of a primitive of triangles.
inline constexpr std::uint64_t kGltfTriangles = 4;
inline constexpr std::uint64_t kGltfFan = 6;  ///< 5 is a strip

/// Memory of a document and of its meshes as often as `meshes` names them, bytes. No number of an
/// accessor is read.
///
/// @errors   Error(Input) as GltfDocument::locate
[[nodiscard]] double gltf_memory_bytes(const GltfDocument& document,
                                       const std::vector<std::uint64_t>& meshes);

}  // namespace frangia
