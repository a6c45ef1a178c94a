#include "frangia/range/internal/pixel_connections.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"
#include "frangia/range/internal/is_connected.h"

namespace frangia {
namespace {

/// A row of pixels; the rays are pairs of coordinates.
struct PixelRow {
  const float* depth_mm;
  const float* sigma_mm;
  const float* rays;
};

/// Tests the pixels of one row against those of another; the same formula as `is_connected`.
FRANGIA_VECTORIZED void connect_rows(const PixelRow& row,
                                     const PixelRow& other_row,
                                     std::ptrdiff_t count,
                                     float max_slope,
                                     std::int32_t side,
                                     std::int32_t* bits) {
  const PixelRow one = row;
  const PixelRow other = other_row;
  const std::int32_t connected_bit = 1 << side;
  const std::int32_t broken_bit = connected_bit << PixelConnections::SideCount;
#pragma GCC ivdep
  for (std::ptrdiff_t x = 0; x < count; ++x) {
    const float a = one.depth_mm[x];
    const float b = other.depth_mm[x];
    const float right = one.rays[2 * x] - other.rays[2 * x];
    const float down = one.rays[2 * x + 1] - other.rays[2 * x + 1];
    const float across = std::sqrt(right * right + down * down) * 0.5F * (a + b);
    const float noise = root_of_squares(one.sigma_mm[x], other.sigma_mm[x]);
    const float limit = max_slope * across + kConnectionSigmas * noise;
    const float step = std::fabs(a - b);
    const std::int32_t measured = step == step ? broken_bit : 0;  // NaN where either is missing
    bits[x] |= step <= limit ? connected_bit : measured;
  }
}

}  // namespace

PixelConnections connect_pixels(const RangeGrid& range,
                                const Image<Eigen::Vector2f>& rays,
                                const PixelBox& box,
                                float max_slope) {
  PixelConnections out{box, Image<std::uint8_t>(box.width(), box.height(), Uninitialized{})};
  parallel_rows(box.height(), [&](int row) {
    std::vector<std::int32_t> bits(static_cast<std::size_t>(box.width()), 0);
    const auto pixels_at = [&](int x, int y) {
      return PixelRow{&range.depth_mm(x, y), &range.sigma_mm(x, y), rays(x, y).data()};
    };
    for (int side = 0; side < PixelConnections::SideCount; ++side) {
      const auto [dx, dy] = PixelConnections::kOffsets[static_cast<std::size_t>(side)];
      const int y = box.top + row + dy;
      if (y >= box.bottom) continue;
      const int from = dx < 0 ? 1 : 0;
      const int count = box.width() - (dx == 0 ? 0 : 1);
      if (count <= 0) continue;
      connect_rows(pixels_at(box.left + from, box.top + row),
                   pixels_at(box.left + from + dx, y),
                   count,
                   max_slope,
                   side,
                   bits.data() + from);
    }
    for (int x = 0; x < box.width(); ++x)
      out.bits(x, row) = static_cast<std::uint8_t>(bits[static_cast<std::size_t>(x)]);
  });
  return out;
}

}  // namespace frangia
