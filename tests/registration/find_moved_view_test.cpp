#include "frangia/registration/internal/find_moved_view.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/local_fit/make_surfel_maps.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::box;
using testing::Shape;
using testing::small_camera_model;

/// An angle with a rib: a push slides along most of the faces that the camera sees.
double angle_iron(const Eigen::Vector3d& p) {
  static const Shape kFoot = box({34.0, 22.0, 4.0}, {0.0, 0.0, -16.0});
  static const Shape kWall = box({4.0, 22.0, 18.0}, {-26.0, 0.0, 2.0});
  static const Shape kRib = box({14.0, 3.0, 9.0}, {-8.0, 5.0, -3.0});
  return std::min({kFoot(p), kWall(p), kRib(p)});
}

/// Six views of it; those of `pushed_views` were taken after a push.
Bundle bundle_of(const std::vector<std::size_t>& pushed_views, const Eigen::Vector3d& push_mm) {
  constexpr std::size_t kViews = 6;
  const CameraModel model = small_camera_model(240, 1200.0);
  const Turntable table{{2.0, 8.0, 650.0}, Eigen::Vector3d(0.03, -0.75, -0.65).normalized()};
  const Shape pushed = [&](const Eigen::Vector3d& p) { return angle_iron(p - push_mm); };
  ViewStore views;
  TableState state{table, {}, {}, {}};
  for (std::size_t i = 0; i < kViews; ++i) {
    const double angle_rad = kTwoPi * static_cast<double>(i) / kViews;
    const bool moved = std::find(pushed_views.begin(), pushed_views.end(), i) != pushed_views.end();
    views.add(testing::snapshot(moved ? pushed : Shape(angle_iron),
                                model,
                                table.rig_from_object(angle_rad),
                                {.seed = static_cast<std::uint32_t>(i + 1)}));
    state.angles_rad.push_back(angle_rad);
  }
  Eigen::VectorXd prior = Eigen::VectorXd::Constant(state.unknowns(), rad_from_deg(0.2));
  prior.head<2>().setConstant(rad_from_deg(1.0));
  prior.segment<2>(2).setConstant(2.0);
  Bundle bundle{make_surfel_maps(views, model, 20000),
                FastCameraModel(model),
                state,
                state,
                prior,
                3.0,
                0.1,
                0.002,
                0,
                {},
                all_view_pairs(kViews)};
  bundle.state.table.point_mm += Eigen::Vector3d(0.3, 0.1, 0.0);
  return bundle;
}

std::optional<MovedView> search(Bundle& bundle) {
  const SurfelLists surfels = pick_all_surfels(bundle.maps, 1000);
  optimize_bundle(bundle, surfels, 30, {});
  return find_moved_view(bundle, surfels, {.reach_mm = 3.0});
}

TEST(FindMovedView, FindsItWhereverItIsInTheTurn) {
  for (const std::size_t view : {0U, 2U, 5U}) {
    Bundle bundle = bundle_of({view}, {0.9, -0.6, 0.0});
    const auto moved = search(bundle);
    ASSERT_TRUE(moved.has_value()) << view;
    EXPECT_EQ(moved->view, view);
    EXPECT_FALSE(moved->alternative.has_value()) << *moved->alternative;
  }
}

TEST(FindMovedView, SuspectsNoneWhenNothingMoved) {
  Bundle bundle = bundle_of({}, Eigen::Vector3d::Zero());
  EXPECT_FALSE(search(bundle).has_value());
}

TEST(FindMovedView, LeavesTheBundleAsItWas) {
  Bundle bundle = bundle_of({1}, {0.9, -0.6, 0.0});
  const SurfelLists surfels = pick_all_surfels(bundle.maps, 1000);
  optimize_bundle(bundle, surfels, 30, {});
  const auto angles_rad = bundle.state.angles_rad;
  const double gate_mm = bundle.gate_mm;
  EXPECT_TRUE(find_moved_view(bundle, surfels, {.reach_mm = 3.0}).has_value());
  EXPECT_EQ(bundle.state.angles_rad, angles_rad);
  EXPECT_EQ(bundle.gate_mm, gate_mm);
  EXPECT_FALSE(bundle.left_out.has_value());
}

TEST(FreeSpaceViolation, GrowsWhenAViewMoves) {
  Bundle bundle = bundle_of({2}, {0.0, 0.0, -2.0});
  bundle.state = bundle.given;
  bundle.gate_mm = 0.2;
  const BundleSums sums = sum(bundle, pick_all_surfels(bundle.maps, 1000));
  EXPECT_GT(free_space_violation(sums, 2), 0.2);
  EXPECT_GT(free_space_violation(sums), 0.05);
  EXPECT_LT(free_space_violation(sums), free_space_violation(sums, 2));
}

}  // namespace
}  // namespace frangia
