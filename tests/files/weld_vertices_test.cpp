#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/join_soup.h"

namespace frangia {
namespace {

using Corners = std::vector<Eigen::Vector3f>;

TEST(WeldVertices, SharesVerticesInOrderOfFirstAppearance) {
  const Corners corners{{5, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  const Mesh mesh = weld_vertices(corners);
  EXPECT_EQ(mesh.vertices_mm, (Corners{{5, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Mesh::Triangle>{{0, 1, 2}, {2, 1, 3}}));
}

TEST(WeldVertices, TreatsZeroAndMinusZeroAsEqual) {
  const Corners corners{
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0F, 0, -0.0F}, {1, -0.0F, 0}, {0, -1, 0}};
  EXPECT_EQ(weld_vertices(corners).vertices_mm.size(), 4U);
}

TEST(WeldVertices, KeepsVerticesThatDifferInTheLastBit) {
  const Corners corners{{1, 0, 0}, {std::nextafter(1.0F, 2.0F), 0, 0}, {0, 1, 0}};
  EXPECT_EQ(weld_vertices(corners).vertices_mm.size(), 3U);
}

TEST(WeldVertices, OmitsATriangleWithTwoIdenticalCorners) {
  const Corners corners{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  EXPECT_TRUE(weld_vertices(corners).triangles.empty());
}

TEST(WeldVertices, RefusesAnIncompleteTriangle) {
  EXPECT_THROW(static_cast<void>(weld_vertices(Corners(4, Eigen::Vector3f::Zero()))), Error);
}

}  // namespace
}  // namespace frangia
