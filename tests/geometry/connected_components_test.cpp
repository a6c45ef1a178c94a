#include <string>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/run.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/vertex_data.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// A box of 2 x 3 x 6, one of 1 x 1 x 1, and one of 1 x 2 x 2.
Mesh three_boxes() {
  Mesh mesh = testing::box({0, 0, 0}, {2, 3, 6});
  append_mesh(mesh, testing::box({10, 0, 0}, {11, 1, 1}));
  append_mesh(mesh, testing::box({20, 0, 0}, {21, 2, 2}));
  return mesh;
}

TEST(ConnectedComponents, HaveTheAreaAndTheDiagonalOfTheirBoxes) {
  const ConnectedComponents found = connected_components(three_boxes());
  ASSERT_EQ(found.components.size(), 3U);
  EXPECT_NEAR(found.components[0].area_mm2, 72.0, 1e-4);
  EXPECT_NEAR(found.components[0].size_mm, 7.0, 1e-6);
  EXPECT_NEAR(found.components[2].area_mm2, 16.0, 1e-4);
  EXPECT_NEAR(found.components[2].size_mm, 3.0, 1e-6);
  EXPECT_EQ(found.component_of[11], 0U);
  EXPECT_EQ(found.component_of[12], 1U);
}

TEST(KeepLargestComponents, KeepsThoseOfTheLargestArea) {
  const Mesh kept = keep_largest_components(three_boxes(), 2);
  EXPECT_EQ(kept.triangles.size(), 24U);
  EXPECT_NEAR(testing::volume_mm3(kept), 36.0 + 4.0, 1e-4);
  EXPECT_THROW(static_cast<void>(keep_largest_components(three_boxes(), 0)), Error);
}

TEST(RemoveIslands, RemovesUpToTheSizeButNeverTheLargest) {
  EXPECT_EQ(remove_islands(three_boxes(), 1.7).triangles.size(), 36U);  // sqrt(3) is larger
  EXPECT_EQ(remove_islands(three_boxes(), 1.8).triangles.size(), 24U);
  EXPECT_EQ(remove_islands(three_boxes(), 100.0).triangles.size(), 12U);
}

TEST(RemoveIslands, SaysWhatItRemovedAndThatTheSizeIsTooLarge) {
  std::string notes;
  std::string warnings;
  frangia::Run run;
  run.on_note = [&](const std::string& text) { notes += text; };
  run.on_warning = [&](const std::string& text) { warnings += text; };
  static_cast<void>(remove_islands(three_boxes(), 3.1, run));
  EXPECT_EQ(notes, "2 of 3 components removed, 24 triangles in total");
  EXPECT_EQ(warnings, "");
  static_cast<void>(remove_islands(three_boxes(), 500.0, run));
  EXPECT_NE(warnings.find("up to 500 mm are all components; the one of the largest area, of 7 mm"),
            std::string::npos)
      << warnings;
}

}  // namespace
}  // namespace frangia
