#include "frangia/indirect_light/extrapolate_faces.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

constexpr int kSize = 240;
constexpr float kSigma_mm = 0.02F;
constexpr int kCrease = kSize / 2;  // column
constexpr int kShifted = 14;        // columns on each side of the crease

Image<Eigen::Vector2f> rays_of_square() {
  Image<Eigen::Vector2f> rays(kSize, kSize, Eigen::Vector2f::Zero());
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x)
      rays(x, y) =
          1e-3F * Eigen::Vector2f(static_cast<float>(x - kCrease), static_cast<float>(y - kCrease));
  }
  return rays;
}

/// Depth of two planes that meet at right angles, at 500 mm: z = 500 -+ |x|.
double depth_at(const Eigen::Vector2f& ray, double sign) {
  return 500.0 / (1.0 + sign * std::abs(static_cast<double>(ray.x())));
}

struct Corner {
  RangeGrid range;
  Image<float> most_mm = Image<float>(kSize, kSize, 0.0F);
  Image<Eigen::Vector2f> rays = rays_of_square();
};

/// A corner whose points near the crease are shifted by 2 mm, or missing next to it.
Corner shifted_corner(double sign) {
  Corner out;
  out.range = {Image<float>(kSize, kSize, 0.0F), Image<float>(kSize, kSize, kSigma_mm)};
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int off = std::abs(x - kCrease);
      const double noise = static_cast<double>(kSigma_mm) *
                           normal_from(hash(3, static_cast<std::uint64_t>(y * kSize + x)));
      double depth = depth_at(out.rays(x, y), sign) + noise;
      if (off <= kShifted) {
        depth += 2.0;
        out.most_mm(x, y) = 5.0F;
      }
      out.range.depth_mm(x, y) = static_cast<float>(depth);
      if (off <= 1) {
        out.range.remove(x, y);
        out.most_mm(x, y) = kMissing;
      }
    }
  }
  return out;
}

double largest_error(const Corner& corner, double sign) {
  const Image<float> found = extrapolate_faces(corner.range, corner.most_mm, corner.rays);
  double largest = 0.0;
  for (int y = 20; y < kSize - 20; ++y) {
    for (int x = kCrease - kShifted; x <= kCrease + kShifted; ++x) {
      const double exact = depth_at(corner.rays(x, y), sign);
      if (std::isnan(found(x, y))) return kMissing;
      largest = std::max(largest, std::abs(static_cast<double>(found(x, y)) - exact));
    }
  }
  return largest;
}

TEST(ExtrapolateFaces, ContinuesBothFacesOfAConcaveEdgeAndClosesTheGap) {
  EXPECT_LT(largest_error(shifted_corner(1.0), 1.0), 0.1);
}

TEST(ExtrapolateFaces, ContinuesBothFacesOfAConvexEdge) {
  EXPECT_LT(largest_error(shifted_corner(-1.0), -1.0), 0.1);
}

TEST(ExtrapolateFaces, KeepsADepthThatWouldHaveToMoveTooFar) {
  Corner corner = shifted_corner(1.0);
  for (float& most : corner.most_mm.pixels())
    if (most > 0.0F) most = 1.0F;
  const Image<float> found = extrapolate_faces(corner.range, corner.most_mm, corner.rays);
  EXPECT_EQ(found(kCrease - 5, 60), corner.range.depth_mm(kCrease - 5, 60));
}

TEST(ExtrapolateFaces, ChangesNothingWhereAllIsReliable) {
  Corner corner = shifted_corner(1.0);
  for (float& most : corner.most_mm.pixels())
    if (most > 0.0F) most = 0.0F;
  const Image<float> found = extrapolate_faces(corner.range, corner.most_mm, corner.rays);
  for (int x = 0; x < kSize; ++x) {
    if (std::isnan(corner.range.depth_mm(x, 60))) continue;
    EXPECT_EQ(found(x, 60), corner.range.depth_mm(x, 60));
  }
}

}  // namespace
}  // namespace frangia
