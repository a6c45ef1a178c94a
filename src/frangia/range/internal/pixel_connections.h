#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "frangia/core/image.h"
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

/// Noise that `is_connected` allows, in sigmas of the difference in depth.
inline constexpr float kConnectionSigmas = 4.0F;

/// std::hypot of floats as the GNU library computes it, inline, so that loops vectorize.
[[nodiscard]] inline float root_of_squares(float a, float b) {
  const auto x = static_cast<double>(a);
  const auto y = static_cast<double>(b);
  return static_cast<float>(std::sqrt(x * x + y * y));
}

/// Whether two neighbouring pixels can lie on one continuous surface: their depths differ by at
/// most `max_slope` times their lateral distance plus 4 sigmas of noise.
///
/// @missing  false where either pixel is missing
[[nodiscard]] inline bool is_connected(const RangeGrid& range,
                                       const Image<Eigen::Vector2f>& rays,
                                       const Eigen::Vector2i& one,
                                       const Eigen::Vector2i& other,
                                       float max_slope) {
  const float a = range.depth_mm(one.x(), one.y());
  const float b = range.depth_mm(other.x(), other.y());
  const float across =
      (rays(one.x(), one.y()) - rays(other.x(), other.y())).norm() * 0.5F * (a + b);
  const float noise =
      root_of_squares(range.sigma_mm(one.x(), one.y()), range.sigma_mm(other.x(), other.y()));
  return std::abs(a - b) <= max_slope * across + kConnectionSigmas * noise;
}

/// Change of depth across a place and over the same distance on either side of it.
struct DepthChange {
  float jump_mm;
  float before_mm;
  float after_mm;
};

/// Whether the jump exceeds the mean change of both sides by more than `least_mm`, and exceeds the
/// change of each side. The second condition excludes slopes, where all three changes are equal,
/// and creases, where the jump equals the change of one side.
///
/// @missing  false where a change is missing
[[nodiscard]] inline bool is_depth_step(const DepthChange& change, float least_mm) {
  const auto& [jump, before, after] = change;
  const float excess = std::abs(jump - 0.5F * (before + after));
  return excess > least_mm && std::abs(jump) > std::max(std::abs(before), std::abs(after));
}

/// The pixels of a view that see a single surface.
struct ReliablePixels {
  const RangeGrid& range;
  const Image<Eigen::Vector2f>& rays;
  float max_slope;  ///< see `is_connected`
};

/// Whether a pixel that is not reliable continues the surface next to it in depth and brightness.
///
/// The reliable pixels around it that are connected to one of its neighbours are extrapolated by
/// quadratic fits of inverse depth and of light. A pixel that mixes two surfaces lies off the first
/// surface. A pixel only partly covered by the surface, at a silhouette or a shadow, is darker.
/// Phase noise falls with the square root of the light, so sigma stands in for brightness.
///
/// @missing  false where too few reliable pixels determine the fits
[[nodiscard]] bool continues_surface(const ReliablePixels& reliable, const RangePixel& pixel);

}  // namespace frangia
