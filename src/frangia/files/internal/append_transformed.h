#pragma once

#include <filesystem>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Appends a part where a transform puts it, facing outwards as it did.
///
/// errors   Error(Input) that names the file when the transform is not finite, or the whole grows
///          beyond 50 million vertices or triangles: a file that names its parts often enough can
///          be small and its mesh larger than any memory
void append_transformed(Mesh& mesh,
                        const Mesh& part,
                        const Eigen::Affine3d& mesh_from_part,
                        const std::filesystem::path& path);

}  // namespace frangia
