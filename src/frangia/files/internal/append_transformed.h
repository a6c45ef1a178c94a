#pragma once

#include <filesystem>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Appends a transformed part. A mirroring transform reverses the triangles, so the part keeps its
/// orientation.
///
/// @errors   Error(Input) that names the file when the transform is not finite
void append_transformed(Mesh& mesh,
                        const Mesh& part,
                        const Eigen::Affine3d& mesh_from_part,
                        const std::filesystem::path& path);

}  // namespace frangia
