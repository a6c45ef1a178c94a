#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Gives every vertex and triangle its mark, so that some can be changed.
void ensure_marks(Mesh& mesh);

/// The mark of a triangle: the least measured of its own and its corners'.
[[nodiscard]] Mark mark_of(const Mesh& mesh, std::size_t triangle);

/// Appends a copy of a vertex with all that is known of it; its number.
std::uint32_t copy_vertex(Mesh& mesh, std::uint32_t from);

/// Appends the vertex at a + t (b - a) with the mean of all that is known of its ends; its number.
std::uint32_t add_interpolated_vertex(Mesh& mesh, std::uint32_t a, std::uint32_t b, float t);

/// Appends a vertex that was not measured: zero views, and the largest sigma of `around`.
std::uint32_t add_synthesized_vertex(Mesh& mesh,
                                     const Eigen::Vector3f& position_mm,
                                     std::span<const std::uint32_t> around);

void add_triangle(Mesh& mesh, const Mesh::Triangle& triangle, Mark mark);

/// Keeps the triangles of which `keep` is not 0, and the vertices that they use, in their order.
void keep_triangles(Mesh& mesh, std::span<const std::uint8_t> keep);

/// Appends another mesh. What one of the two does not know of its vertices is filled in: zero
/// normals, NaN sigma, no views.
void append_mesh(Mesh& mesh, const Mesh& other);

/// Marks as moved the measured vertices that lie farther than their sigma from where they were;
/// those without a sigma when they moved at all, beyond a thousandth of a millimetre.
void mark_displaced(Mesh& mesh, std::span<const Eigen::Vector3f> before_mm);

/// Computes the normals anew, when the mesh has any.
void recompute_normals(Mesh& mesh);

}  // namespace frangia
