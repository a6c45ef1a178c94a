#pragma once

#include <filesystem>
#include <span>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Joins the triangles of a soup: a mesh in which most edges have a single triangle, since each
/// triangle or face has vertices of its own. Of other meshes, edges with a single triangle are
/// joined: programs write a vertex twice where normals or texture coordinates differ, and a closed
/// part then falls into pieces.
///
/// Two triangles are joined at an edge that both have at the same positions and in opposite
/// directions. Where more than two meet at an edge, those are joined that enclose material between
/// them, so that closed bodies that touch stay apart. Vertices with different colors, sigma, views
/// or marks are not joined. Normals are left out where vertices with different ones are joined. A
/// warning says what was joined.
///
/// @errors   Error(Cancelled)
[[nodiscard]] Mesh join_soup(Mesh mesh, const std::filesystem::path& path, const Run& run);

/// Merges corners with identical coordinates into shared vertices. Shells that touch each other
/// stay apart, see `separate_shells`.
///
/// @shape    three corners per triangle; vertices are numbered in order of first appearance, those
///           where shells touch at the end
/// @missing  a triangle with two identical corners is omitted
/// @errors   Error(Input) when the number of corners is not a multiple of three or exceeds 32 bits
[[nodiscard]] Mesh weld_vertices(std::span<const Eigen::Vector3f> corners_mm);

}  // namespace frangia
