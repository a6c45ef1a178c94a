#include <gtest/gtest.h>

#include "frangia/registration/internal/optimize_bundle.h"

#include "support/misaligned_table.h"

namespace frangia {
namespace {

TEST(MakeBundle, DoesNotPairTheOnlyViewOfTheFirstSetupWithItself) {
  const testing::MisalignedTable table(3);
  const CameraModel camera = testing::small_camera_model(60, 300.0);
  const ViewStore views = table.take(testing::knobbly, camera);
  const TableState given{table.given, table.angles_rad, {0, 1, 1}, {Eigen::Isometry3d::Identity()}};
  EXPECT_EQ(make_bundle(views, camera, given, {}, {}).pairs, all_view_pairs(3));
}

}  // namespace
}  // namespace frangia
