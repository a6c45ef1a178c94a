#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A triangle at an edge.
struct EdgeSide {
  Eigen::Vector3d apex_mm;  ///< the corner that is not on the edge, mm
  bool upward = false;      ///< whether the triangle runs from the edge's first end to the second
  std::uint32_t shell = 0;  ///< what it is connected with over edges of two triangles
};

/// The partner of a side that has none.
inline constexpr std::size_t kNoPartner = std::numeric_limits<std::size_t>::max();

/// Whether the triangles of a mesh are clockwise seen from outside, by the volume that they
/// enclose. Its sides enclose material where `upward` is exchanged.
[[nodiscard]] bool is_inside_out(const Mesh& mesh);

/// Pairs the triangles that meet at an edge so that shells which touch there stay apart: two of one
/// shell are a pair unless they are front and back of one face; the others are paired as they
/// enclose material, behind an upward side, against the sense of rotation, the next downward one.
///
/// @shape    the partner of each side, by its index
/// @missing  kNoPartner
[[nodiscard]] std::vector<std::size_t> pair_sides(const Eigen::Vector3d& first_end_mm,
                                                  const Eigen::Vector3d& second_end_mm,
                                                  std::span<const EdgeSide> sides);

}  // namespace frangia
