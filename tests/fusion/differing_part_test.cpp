#include "frangia/fusion/internal/differing_part.h"

#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

ViewStore stored_at(const std::vector<double>& longitudes_deg) {
  std::vector<Eigen::Isometry3d> poses;
  for (const double longitude : longitudes_deg)
    poses.push_back(testing::look_from(rad_from_deg(longitude), 0.0, 600.0));
  return testing::snapshots(testing::sphere(5.0), testing::small_camera_model(32), poses);
}

TEST(HaveDirectionsOfTheirOwn, NeedsFiveDegreesBetweenAnyTwoViewsOfAllStores) {
  const ViewStore far = stored_at({0.0, 20.0, 40.0});
  const ViewStore beside = stored_at({60.0, 25.5});
  const ViewStore near = stored_at({60.0, 24.5});
  EXPECT_TRUE(have_directions_of_their_own({&far}));
  EXPECT_TRUE(have_directions_of_their_own({&far, &beside}));
  EXPECT_FALSE(have_directions_of_their_own({&far, &near}));
  const ViewStore last = stored_at({0.0, 50.0, 54.0});
  EXPECT_FALSE(have_directions_of_their_own({&last}));
  EXPECT_TRUE(have_directions_of_their_own({}));
}

TEST(DifferingPart, IsTheRootOfItsShareOfTheVariance) {
  View view;
  EXPECT_TRUE(differing_part(view).empty());
  view.range.systematic_mm = Image<float>(3, 2, 0.4F);
  view.range.differing_share = 0.0F;
  EXPECT_TRUE(differing_part(view).empty());
  view.range.differing_share = 0.25F;
  const Image<float> parts = differing_part(view);
  for (const float part : parts.pixels())
    EXPECT_FLOAT_EQ(part, 0.2F);
}

}  // namespace
}  // namespace frangia
