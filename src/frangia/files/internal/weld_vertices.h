#pragma once

#include <span>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Merges corners with identical coordinates into shared vertices. Shells that touch each other
/// stay apart, see `separate_shells`.
///
/// @shape    three corners per triangle; vertices are numbered in order of first appearance, those
///           where shells touch at the end
/// @missing  a triangle with two identical corners is omitted
/// @errors   Error(Input) when the number of corners is not a multiple of three or exceeds 32 bits
[[nodiscard]] Mesh weld_vertices(std::span<const Eigen::Vector3f> corners_mm);

}  // namespace frangia
