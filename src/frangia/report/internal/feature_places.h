#pragma once

#include <cstdint>
#include <vector>

#include "frangia/features/shape.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspect/render_mesh.h"

namespace frangia::report {

/// Places of a mesh where a label may point at a feature, the best first: on the vertices that it
/// was fitted to, around its middle; where these do not lie on it, on its shape.
///
/// `normals` are those of the vertices of the mesh; `vertices` may be empty.
[[nodiscard]] std::vector<PicturedPlace> feature_places(const Mesh& mesh,
                                                        const std::vector<Eigen::Vector3f>& normals,
                                                        const Shape& shape,
                                                        const std::vector<std::uint32_t>& vertices);

}  // namespace frangia::report
