#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace frangia {

/// A triangle with a point on some of its edges: corner i, the point 3 + i on the edge from corner
/// i to the next, and 6 within.
struct SplitTriangle {
  std::array<Eigen::Vector3f, 7> points;
  unsigned split = 0;  ///< bit i: edge i has a point; all three need the one within, too

  using Piece = std::array<std::uint8_t, 3>;
  std::array<Piece, 6> pieces{};
  std::size_t count = 0;
};

/// Cuts it into one to six pieces, all turned as it is: no edge of one leaps over a point.
void triangulate(SplitTriangle& triangle);

}  // namespace frangia
