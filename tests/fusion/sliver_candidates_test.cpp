#include <gtest/gtest.h>

#include "frangia/fusion/internal/remove_slivers.h"

namespace frangia {
namespace {

using Which = std::vector<std::uint32_t>;

/// A regular triangle, one with a short edge, and one of low height.
Mesh three() {
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.01F, 1, 0}, {0.5F, -0.01F, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 2}, {1, 0, 4}};
  return mesh;
}

TEST(SliverCandidates, HoldShortEdgesAndLowTriangles) {
  EXPECT_EQ(SliverCandidates(three(), 0.02F, 0.001F).triangles(), Which{1});
  EXPECT_EQ(SliverCandidates(three(), 0.001F, 0.02F).triangles(), (Which{1, 2}));
}

TEST(SliverCandidates, KeepEachOnceAndInOrder) {
  SliverCandidates candidates(three(), 0.02F, 0.001F);
  candidates.add({0, 1});
  EXPECT_EQ(candidates.triangles(), (Which{0, 1}));
}

}  // namespace
}  // namespace frangia
