#include "frangia/features/internal/search_regions.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "frangia/features/internal/surface_cells.h"

#include "features/noisy_shapes.h"

namespace frangia {
namespace {

using testing::add_patch;

constexpr int kSide = 30;  // points along the edge of a patch

/// A square of 60 mm at z = 0, and one of 30 mm at x = 100 that faces x.
Mesh two_squares(double noise_mm) {
  Mesh mesh;
  add_patch(mesh, kSide, kSide, noise_mm, 3, [](double u, double v) {
    return Eigen::Vector3d(60.0 * u, 60.0 * v, 0.0);
  });
  add_patch(mesh, kSide, kSide, noise_mm, 4, [](double u, double v) {
    return Eigen::Vector3d(100.0, 30.0 * u, 30.0 * v);
  });
  return mesh;
}

struct Search {
  FeaturePoints points;
  SurfaceCells cells;
  FoundRegions found;
};

Search searched(const Mesh& mesh, FindFeaturesOptions options = {}) {
  options.seeds = 24;
  Search out;
  out.points = feature_points_of(mesh, {});
  out.cells = surface_cells(out.points, out.points.size() / 4);
  out.found = search_regions(out.points, out.cells, options, {});
  return out;
}

TEST(SearchRegions, TakesTheGateFromTheScatterOfThePoints) {
  for (const double noise_mm : {0.01, 0.04}) {
    const Search search = searched(two_squares(noise_mm));
    EXPECT_NEAR(search.found.gate_mm, 4.5 * noise_mm, 0.25 * 4.5 * noise_mm);
  }
}

TEST(SearchRegions, TakesTheGateOfAnExactSurfaceFromTheSizeOfItsCells) {
  const Search search = searched(two_squares(0.0));
  EXPECT_NEAR(search.found.gate_mm, 4.5 * 0.002 * search.cells.edge_mm, 1e-9);
}

TEST(SearchRegions, TakesTheGateThatIsGiven) {
  EXPECT_EQ(searched(two_squares(0.01), {.gate_mm = 0.7}).found.gate_mm, 0.7);
}

TEST(SearchRegions, FindsTheLargerOfTwoSquaresFirstAndEachCellOnce) {
  const Search search = searched(two_squares(0.01));
  ASSERT_EQ(search.found.regions.size(), 2U);
  std::set<std::uint32_t> taken;
  for (std::size_t i = 0; i < 2; ++i) {
    const ShapeRegion& region = search.found.regions[i];
    EXPECT_EQ(region.shape.kind, ShapeKind::Plane);
    EXPECT_NEAR(std::abs(region.shape.axis(i == 0 ? 2 : 0)), 1.0, 1e-4);
    for (const std::uint32_t cell : region.cells) {
      EXPECT_EQ(search.cells.points_mm[cell].x() > 80.0, i == 1);
      EXPECT_TRUE(taken.insert(cell).second);
    }
  }
  EXPECT_GT(search.found.regions[0].cells.size(), search.found.regions[1].cells.size());
  EXPECT_GT(static_cast<double>(taken.size()), 0.95 * static_cast<double>(search.cells.size()));
}

TEST(SearchRegions, LeavesOutRegionsBelowTheLeastShare) {
  // The smaller square is a fifth of the area.
  EXPECT_EQ(searched(two_squares(0.01), {.least_area_share = 0.3}).found.regions.size(), 1U);
}

}  // namespace
}  // namespace frangia
