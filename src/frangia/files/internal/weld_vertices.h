#pragma once

#include <span>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The mesh of loose triangles: corners at the very same place become one vertex.
///
/// shape    three corners a triangle; vertices are numbered as they first appear
/// missing  a triangle with two corners at one place has no area and is left out
[[nodiscard]] Mesh weld_vertices(std::span<const Eigen::Vector3f> corners_mm);

}  // namespace frangia
