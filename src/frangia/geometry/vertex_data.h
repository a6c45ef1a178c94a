#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Gives every vertex and triangle a mark, `Measured` by default.
void ensure_marks(Mesh& mesh);

/// Returns the largest mark of a triangle and its vertices.
[[nodiscard]] Mark mark_of(const Mesh& mesh, std::size_t triangle);

/// Appends a copy of a vertex with all its attributes and returns its number.
std::uint32_t copy_vertex(Mesh& mesh, std::uint32_t from);

/// Appends the vertex at a + t (b - a) with interpolated attributes and returns its number. The
/// number of views is that of the nearer end.
std::uint32_t add_interpolated_vertex(Mesh& mesh, std::uint32_t a, std::uint32_t b, float t);

/// Appends a synthesized vertex, with zero views and the largest sigma of `around`, and returns its
/// number.
///
/// @units    mm
/// @missing  its sigma is NaN when `around` is empty, its normal is zero
std::uint32_t add_synthesized_vertex(Mesh& mesh,
                                     const Eigen::Vector3f& position_mm,
                                     std::span<const std::uint32_t> around);

/// Appends a triangle with a mark.
void add_triangle(Mesh& mesh, const Mesh::Triangle& triangle, Mark mark);

/// Keeps the triangles whose flag is not 0, and the vertices that they use, in their order.
///
/// @errors   Error(Input) when there is not one flag for each triangle
void keep_triangles(Mesh& mesh, std::span<const std::uint8_t> keep);

/// Appends another mesh.
///
/// @missing  attributes that only one of the meshes has are zero normals, NaN sigma or zero views
/// for
///          the vertices of the other
/// @errors   Error(Input) for more than 4 billion vertices
void append_mesh(Mesh& mesh, const Mesh& other);

/// Marks the measured vertices as displaced that lie farther than their sigma from `before_mm`. A
/// vertex without a sigma is displaced when it moved by more than 1e-5 of the size of the mesh.
void mark_displaced(Mesh& mesh, std::span<const Eigen::Vector3f> before_mm);

/// Recomputes the vertex normals if the mesh has any.
void recompute_normals(Mesh& mesh);

}  // namespace frangia
