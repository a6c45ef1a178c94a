#include <string>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/distance_field.h"
#include "frangia/fusion/internal/sampling.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

TEST(VoxelBudget, AssumesTheCrossingsOfASphere) {
  // The command that measured kCrossedShare and kCrossingsPerBlock.
  const CameraRays camera(testing::small_camera_model(600, 3000.0));
  TruncationBand band;
  band.voxel_mm = 0.4;
  band.front_mm = 1.3;
  band.back_mm = 0.9;
  band.falloff_mm = 0.3;
  band.allocation_mm = 0.38;
  band.deepest_mm = 9.0;
  DistanceField field;
  field.voxel_mm = band.voxel_mm;
  for (const auto& pose : testing::all_around(6, 650.0)) {
    const View view = testing::snapshot(testing::sphere(50.0), camera.model, pose);
    integrate_view(field, local_planes(view, camera), camera, band);
  }
  const EdgeCrossings crossings = find_edge_crossings(field);
  const auto blocks = static_cast<double>(field.blocks.size());
  const auto crossed = static_cast<double>(crossings.blocks.size());
  EXPECT_NEAR(crossed / blocks, 0.63, 0.08);
  EXPECT_NEAR(static_cast<double>(crossings.points_mm.size()) / crossed, 64.0, 12.0);
}

TEST(VoxelBudget, IsProportionalToTheMemoryAllowed) {
  const VoxelBudget small = voxel_budget(0.5, 100);
  const VoxelBudget large = voxel_budget(0.5, 400);
  EXPECT_GT(small.max_blocks, 500U);
  EXPECT_NEAR(
      static_cast<double>(large.max_blocks) / static_cast<double>(small.max_blocks), 4.0, 0.01);
}

TEST(VoxelBudget, RefusesMoreBlocksThanFitAndNamesALargerVoxel) {
  const VoxelBudget budget = voxel_budget(0.5, 100);
  EXPECT_NO_THROW(budget.check(static_cast<double>(budget.max_blocks)));
  try {
    budget.check(4.0 * static_cast<double>(budget.max_blocks));
    FAIL();
  } catch (const Error& error) {
    const std::string what = error.what();
    ASSERT_NE(what.find("voxels of 0.5 mm need 0.4 GB"), std::string::npos) << what;
    // Four times the blocks: at least twice the voxel.
    EXPECT_GT(std::stod(what.substr(what.rfind("voxels of ") + 10)), 1.0);
  }
}

}  // namespace
}  // namespace frangia
