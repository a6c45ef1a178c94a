#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace frangia {

/// A triangle with additional points: 0 to 2 are its corners, 3 + i lies on the edge from corner i
/// to the next, and 6 lies inside.
struct SplitTriangle {
  std::array<Eigen::Vector3f, 7> points;
  unsigned split = 0;  ///< bit i: edge i has a point; with all three, the inner point is used, too

  using Piece = std::array<std::uint8_t, 3>;
  std::array<Piece, 6> pieces{};
  std::size_t count = 0;
};

/// Cuts the triangle into one to six pieces of the same orientation with all its points as corners.
void triangulate(SplitTriangle& triangle);

}  // namespace frangia
