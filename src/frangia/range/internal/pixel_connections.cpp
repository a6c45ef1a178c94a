#include "frangia/range/internal/pixel_connections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Cholesky>

#include "frangia/core/image.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"

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

namespace {

using Vector6 = Eigen::Matrix<float, 6, 1>;
using Matrix6 = Eigen::Matrix<float, 6, 6>;

constexpr int kRadius = 3;
constexpr int kSide = 2 * kRadius + 1;
constexpr int kMinFitPixels = 10;       // for six unknowns and their residuals
constexpr float kMaxLeverage = 8.0F;    // variance of the extrapolated value, per pixel variance
constexpr float kRough = 4.0F;          // maximum residual variance of the fit, per pixel variance
constexpr float kSigmas = 3.0F;         // maximum distance of the pixel from the extrapolation
constexpr float kMinBrightness = 0.7F;  // per expected light; a darker pixel is partly covered

constexpr std::size_t kPixels = std::size_t{kSide} * kSide;

/// Connected pixels of the window around a pixel.
struct Group {
  std::array<Eigen::Vector2i, kPixels> at;
  std::size_t count = 0;
};

bool is_seen(const ReliablePixels& reliable, const Eigen::Vector2i& p) {
  const auto& depth = reliable.range.depth_mm;
  return p.minCoeff() >= 0 && p.x() < depth.width() && p.y() < depth.height() &&
         !std::isnan(depth(p.x(), p.y()));
}

Group connected_group(const ReliablePixels& reliable,
                      const Eigen::Vector2i& middle,
                      const Eigen::Vector2i& start) {
  std::array<bool, kPixels> seen{};
  Group group;
  const auto add = [&](const Eigen::Vector2i& p) {
    const Eigen::Vector2i from = p - middle + Eigen::Vector2i::Constant(kRadius);
    const int index = from.y() * kSide + from.x();
    bool& known = seen[static_cast<std::size_t>(index)];
    if (!known) group.at[group.count++] = p;
    known = true;
  };
  add(start);
  for (std::size_t head = 0; head < group.count; ++head) {
    const Eigen::Vector2i p = group.at[head];
    for (const auto& [dx, dy] : kFourNeighbors) {
      const Eigen::Vector2i next = p + Eigen::Vector2i(dx, dy);
      if ((next - middle).cwiseAbs().maxCoeff() > kRadius || !is_seen(reliable, next)) continue;
      if (is_connected(reliable.range, reliable.rays, p, next, reliable.max_slope)) add(next);
    }
  }
  return group;
}

Vector6 powers(const Eigen::Vector2i& from) {
  const auto x = static_cast<float>(from.x());
  const auto y = static_cast<float>(from.y());
  Vector6 row;
  row << 1.0F, x, y, x * x, x * y, y * y;
  return row;
}

bool extrapolates_to(const ReliablePixels& reliable,
                     const Group& group,
                     const Eigen::Vector2i& at,
                     const RangePixel& pixel) {
  if (group.count < kMinFitPixels) return false;
  const Image<float>& depth = reliable.range.depth_mm;
  const Image<float>& sigma = reliable.range.sigma_mm;
  const float here = 1.0F / pixel.depth_mm;
  Matrix6 normal = Matrix6::Zero();
  Vector6 right_side = Vector6::Zero();  // relative to the pixel's inverse depth, to keep precision
  Vector6 light = Vector6::Zero();       // relative to the pixel's light
  float squares = 0.0F;
  for (std::size_t i = 0; i < group.count; ++i) {
    const Eigen::Vector2i& p = group.at[i];
    const Vector6 row = powers(p - at);
    const float off = 1.0F / depth(p.x(), p.y()) - here;
    const float ratio = pixel.sigma_mm / sigma(p.x(), p.y());
    normal += row * row.transpose();
    right_side += off * row;
    light += ratio * ratio * row;
  }
  const Eigen::LDLT<Matrix6> solver(normal);
  const Vector6 fit = solver.solve(right_side);
  const float leverage = solver.solve(Vector6::Unit(0))[0];
  if (!fit.allFinite() || !(leverage > 0.0F && leverage < kMaxLeverage)) return false;
  if (!(kMinBrightness * solver.solve(light)[0] < 1.0F)) return false;
  for (std::size_t i = 0; i < group.count; ++i) {
    const Eigen::Vector2i& p = group.at[i];
    const float off = 1.0F / depth(p.x(), p.y()) - here - powers(p - at).dot(fit);
    squares += off * off;
  }
  const float noise = pixel.sigma_mm * here * here;
  const float variance = noise * noise;
  if (squares > kRough * variance * static_cast<float>(group.count - 6)) return false;
  return fit[0] * fit[0] < kSigmas * kSigmas * variance * (1.0F + leverage);
}

}  // namespace

bool continues_surface(const ReliablePixels& reliable, const RangePixel& pixel) {
  const Eigen::Vector2i at(pixel.x, pixel.y);
  return std::any_of(kFourNeighbors.begin(), kFourNeighbors.end(), [&](const auto& step) {
    const Eigen::Vector2i next = at + Eigen::Vector2i(step[0], step[1]);
    return is_seen(reliable, next) &&
           extrapolates_to(reliable, connected_group(reliable, at, next), at, pixel);
  });
}

}  // namespace frangia
