#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/pixel_box.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// Which neighbouring pixels of a range grid can lie on one surface, see `is_connected`. Each pair
/// of neighbours is tested once.
struct PixelConnections {
  /// The neighbours that a pixel holds the bits of; the opposite neighbours hold the other pairs.
  enum Side : int { Right, LowerLeft, Down, LowerRight, SideCount };
  struct Offset {
    int x;
    int y;
  };
  static constexpr std::array<Offset, SideCount> kOffsets{{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

  PixelBox box;
  /// Of the pixels of `box`: bit `side` for a connected neighbour, bit `SideCount + side` for a
  /// measured one that is not connected.
  Image<std::uint8_t> bits;

  /// Whether pixel (x, y) and its neighbour are connected. False outside of the box.
  [[nodiscard]] bool connected(int x, int y, Side side) const { return has(x, y, side); }
  /// Whether pixel (x, y) and its neighbour are both measured, but not connected.
  [[nodiscard]] bool broken(int x, int y, Side side) const { return has(x, y, SideCount + side); }

 private:
  [[nodiscard]] bool has(int x, int y, int bit) const {
    const bool within = x >= box.left && x < box.right && y >= box.top && y < box.bottom;
    return within && (bits(x - box.left, y - box.top) >> bit & 1) != 0;
  }
};

/// Connects the pixels of a box that holds all measured pixels.
[[nodiscard]] PixelConnections connect_pixels(const RangeGrid& range,
                                              const Image<Eigen::Vector2f>& rays,
                                              const PixelBox& box,
                                              float max_slope);

}  // namespace frangia
