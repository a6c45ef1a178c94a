#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/fusion/internal/remove_slivers.h"

namespace frangia {
namespace {

/// A triangle with points in the middle of its split edges.
SplitTriangle with_points(unsigned split) {
  SplitTriangle t;
  t.points[0] = {0.0F, 0.0F, 0.0F};
  t.points[1] = {2.0F, 0.0F, 0.0F};
  t.points[2] = {0.0F, 2.0F, 0.0F};
  for (std::size_t i = 0; i < 3; ++i)
    t.points[3 + i] = 0.5F * (t.points[i] + t.points[(i + 1) % 3]);
  t.points[6] = (t.points[0] + t.points[1] + t.points[2]) / 3.0F;
  t.split = split;
  triangulate(t);
  return t;
}

TEST(SplitTriangle, IsCoveredByItsPiecesWhateverIsSplit) {
  for (unsigned split = 0; split < 8; ++split) {
    const SplitTriangle t = with_points(split);
    float area = 0.0F;
    for (std::size_t i = 0; i < t.count; ++i) {
      const auto& [a, b, c] = t.pieces[i];
      const float piece = (t.points[b] - t.points[a]).cross(t.points[c] - t.points[a]).z() / 2.0F;
      EXPECT_GT(piece, 0.1F) << split;
      area += piece;
    }
    EXPECT_NEAR(area, 2.0F, 1e-6F) << split;
  }
}

TEST(SplitTriangle, HasItsPointsAsCorners) {
  for (unsigned split = 0; split < 8; ++split) {
    const SplitTriangle t = with_points(split);
    unsigned used = 0;
    for (std::size_t i = 0; i < t.count; ++i) {
      for (const auto point : t.pieces[i])
        used |= 1U << point;
    }
    EXPECT_EQ(used, 7U | split << 3U | (split == 7U ? 64U : 0U));
  }
}

}  // namespace
}  // namespace frangia
