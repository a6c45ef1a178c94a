#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/enum_names.h"

namespace frangia {

/// Whether the position of a vertex or triangle was measured. A larger value is farther from a
/// measurement.
enum class Mark : std::uint8_t {
  Measured,    ///< by the scan, or moved by no more than its sigma
  Displaced,   ///< moved by more than its sigma
  Synthesized  ///< created where nothing was measured
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(Mark /*any*/) {
  return EnumNames<Mark, 3>{{{Mark::Measured, "measured"},
                             {Mark::Displaced, "displaced"},
                             {Mark::Synthesized, "synthesized"}}};
}

/// Red, green and blue from 0 to 255 as a screen shows them (sRGB).
using VertexColor = std::array<std::uint8_t, 3>;

/// Color of vertices of which none is known, beside others that have one: light grey.
inline constexpr VertexColor kUnknownColor{204, 204, 204};

/// A triangle mesh in the object frame. Triangles are counter-clockwise seen from outside.
struct Mesh {
  using Triangle = std::array<std::uint32_t, 3>;  ///< indices of the three corners in `vertices_mm`

  std::vector<Eigen::Vector3f> vertices_mm;  ///< positions, object frame
  std::vector<Triangle> triangles;           ///< counter-clockwise seen from outside
  std::vector<Eigen::Vector3f> normals;      ///< unit, one for each vertex, or empty
  /// Combined standard uncertainty along the normal, one for each vertex, or empty.
  std::vector<float> sigma_mm;
  /// The part of `sigma_mm` that is noise. Empty when no systematic part is known: `sigma_mm` is
  /// then noise alone.
  std::vector<float> sigma_noise_mm;
  /// The systematic part of `sigma_mm`, or empty.
  std::vector<float> sigma_systematic_mm;
  std::vector<std::uint16_t> views;  ///< number that observed it, one for each vertex, or empty
  std::vector<VertexColor> colors;   ///< one for each vertex, or empty
  std::vector<Mark> vertex_marks;    ///< one for each vertex; empty: all measured
  std::vector<Mark> triangle_marks;  ///< one for each triangle; empty: all measured

  [[nodiscard]] bool empty() const { return triangles.empty(); }  ///< whether it has no triangles
};

/// Computes vertex normals as angle-weighted means of the adjacent triangles.
///
/// @missing  the normal of a vertex without a triangle of positive area is zero
[[nodiscard]] std::vector<Eigen::Vector3f> vertex_normals(const Mesh& mesh);

}  // namespace frangia
