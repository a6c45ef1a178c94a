#include "frangia/local_fit/internal/extrapolate_planes.h"

#include <gtest/gtest.h>

namespace frangia {
namespace {

/// 9 x 9 pixels, of which only the central one has a plane.
LocalPlanes single_plane() {
  LocalPlanes view;
  view.planes = Image<LocalPlanes::Plane>(9, 9);
  view.quads = Image<LocalPlanes::Quad>(8, 8);
  LocalPlanes::Plane& plane = view.planes(4, 4);
  plane.normal = -Eigen::Vector3f::UnitZ();
  plane.distance_mm = 500.0F;
  plane.weight = 1.0F;
  return view;
}

TEST(ExtrapolatePlanes, ReachesPixelsUpToTheDistance) {
  LocalPlanes view = single_plane();
  extrapolate_planes(view, 2);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const int distance = std::abs(x - 4) + std::abs(y - 4);
      EXPECT_EQ(view.has_plane(x, y), distance <= 2) << x << " " << y;
      EXPECT_EQ(view.planes(x, y).weight > 0.0F, distance == 0) << x << " " << y;
    }
  }
}

TEST(ExtrapolatePlanes, MarksTheQuadsThatItReaches) {
  LocalPlanes view = single_plane();
  extrapolate_planes(view, 1);
  EXPECT_EQ(view.quads(4, 4).kind, LocalPlanes::Kind::Extrapolated);
  EXPECT_EQ(view.quads(5, 4).kind, LocalPlanes::Kind::Extrapolated);
  EXPECT_EQ(view.quads(6, 4).kind, LocalPlanes::Kind::Unseen);
  const Eigen::Vector3f in_front(0.0F, 0.0F, 499.0F);
  EXPECT_NEAR(view.extrapolated_mm(4.5F, 4.5F, in_front), 1.0F, 1e-4F);
}

}  // namespace
}  // namespace frangia
