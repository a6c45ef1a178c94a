#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/geometry/mesh.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {

/// Returns the noise of the vertices: `sigma_noise_mm`, or `sigma_mm` when no systematic part is
/// known. Operations that weight by sigma use it, because averaging reduces noise only.
[[nodiscard]] const std::vector<float>& noise_mm_of(const Mesh& mesh);

/// Splits `sigma_mm` into its parts where only the combined value is known: all of it is noise.
/// Does nothing when the mesh has no sigma, or has the parts already.
void ensure_sigma_parts(Mesh& mesh);

/// Sets `sigma_mm` to the combination of both parts at every vertex.
///
/// @shape    a mesh with both parts
void combine_sigma_parts(Mesh& mesh);

/// Sets `sigma_mm` and its parts to NaN at every vertex.
void discard_sigma(Mesh& mesh);

/// Sets the sigma of a vertex: `value_of` returns its new value in the array that it is given. Both
/// parts are set when the mesh has them, and combined. Does nothing when the mesh has no sigma.
template <typename ValueOf>
void set_sigma(Mesh& mesh, std::uint32_t vertex, const ValueOf& value_of) {
  if (mesh.sigma_mm.empty()) return;
  if (mesh.sigma_systematic_mm.empty()) {
    mesh.sigma_mm[vertex] = value_of(mesh.sigma_mm);
    return;
  }
  mesh.sigma_noise_mm[vertex] = value_of(mesh.sigma_noise_mm);
  mesh.sigma_systematic_mm[vertex] = value_of(mesh.sigma_systematic_mm);
  mesh.sigma_mm[vertex] =
      combined_sigma(mesh.sigma_noise_mm[vertex], mesh.sigma_systematic_mm[vertex]);
}

/// Returns a + t (b - a) for each channel.
[[nodiscard]] VertexColor mix_colors(const VertexColor& a, const VertexColor& b, float t);

/// Gives every vertex and triangle a mark, `Measured` by default.
void ensure_marks(Mesh& mesh);

/// Returns the largest mark of a triangle and its vertices.
[[nodiscard]] Mark mark_of(const Mesh& mesh, std::size_t triangle);

/// Appends a copy of a vertex with all its attributes and returns its number.
std::uint32_t copy_vertex(Mesh& mesh, std::uint32_t from);

/// Appends the vertex at a + t (b - a) with interpolated attributes and returns its number. The
/// number of views is that of the nearer end.
std::uint32_t add_interpolated_vertex(Mesh& mesh, std::uint32_t a, std::uint32_t b, float t);

/// Appends a synthesized vertex, with zero views, the largest sigma of `around` and the mean of
/// their colors, weighted by one over the squared distance, and returns its number.
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
/// @missing  attributes that only one of the meshes has are zero normals, NaN sigma, zero views or
///           `kUnknownColor` for the vertices of the other; a sigma without parts counts as noise
///           alone
/// @errors   Error(Input) for more than 4 billion vertices
void append_mesh(Mesh& mesh, const Mesh& other);

/// Marks the measured vertices as displaced that lie farther than their sigma from `before_mm`. A
/// vertex without a sigma is displaced when it moved by more than 1e-5 of the size of the mesh.
void mark_displaced(Mesh& mesh, std::span<const Eigen::Vector3f> before_mm);

/// Recomputes the vertex normals if the mesh has any.
void recompute_normals(Mesh& mesh);

/// Medians of the uncertainties of a mesh's vertices.
///
/// @units    mm
/// @missing  NaN without a known value; the parts are NaN when no systematic part is known
struct MedianSigma {
  double combined_mm = kMissing;    ///< median of `Mesh::sigma_mm`
  double noise_mm = kMissing;       ///< median of `Mesh::sigma_noise_mm`
  double systematic_mm = kMissing;  ///< median of `Mesh::sigma_systematic_mm`
};

/// Computes the medians of the known values. The medians of the parts do not combine to that of
/// their combination.
[[nodiscard]] MedianSigma median_sigma(const Mesh& mesh);

/// Diffuse colors of the marks as linear red, green, blue, indexed by Mark: measured light grey,
/// displaced yellow, synthesized blue. Pictures and the materials of files use them.
inline constexpr std::array<std::array<double, 3>, 3> kMarkColors{
    {{0.80, 0.775, 0.74}, {0.80, 0.58, 0.12}, {0.12, 0.36, 0.72}}};

/// The color of a mark.
[[nodiscard]] inline const std::array<double, 3>& mark_color(Mark mark) {
  return kMarkColors.at(static_cast<std::size_t>(mark));
}

/// The color of a mark as red, green, blue of a screen with gamma 2.2.
[[nodiscard]] inline std::array<std::uint8_t, 3> mark_screen_color(Mark mark) {
  std::array<std::uint8_t, 3> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double value = std::pow(mark_color(mark).at(i), 1.0 / 2.2);
    bytes.at(i) = static_cast<std::uint8_t>(std::lround(255.0 * value));
  }
  return bytes;
}

}  // namespace frangia
