#include "frangia/registration/register_views.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "frangia/core/error.h"

#include "support/misaligned_table.h"

namespace frangia {
namespace {

using testing::axis_error_rad;
using testing::knobbly;
using Table = testing::MisalignedTable;
using testing::Shape;
using testing::shift_mm;
using testing::small_camera_model;

/// A plate seen from both sides: the views share the narrow top alone.
const Shape kPlate = testing::box({3.0, 30.0, 30.0});

/// Registering changes the poses of the views: each test has its own.
ViewStore copy_of(const ViewStore& views) {
  ViewStore out;
  for (std::size_t i = 0; i < views.size(); ++i)
    out.add(views.load(i));
  return out;
}

/// The tests run in one process, and share what takes long: rendering, and a registration.
class RegisterViews : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { static_cast<void>(eight_views()); }

  static CameraModel camera() { return small_camera_model(200, 1000.0); }
  /// Views of the knobbly part all around, as `MisalignedTable::take` renders them.
  static ViewStore knobbly_views(int count) {
    constexpr int kMost = 8;
    if (count < kMost && kMost % count == 0) {  // some of the eight, evenly spaced
      const ViewStore all = knobbly_views(kMost);
      ViewStore some;
      for (int i = 0; i < count; ++i)
        some.add(all.load(static_cast<std::size_t>(i * kMost / count)));
      return some;
    }
    static std::map<int, ViewStore> rendered;
    const auto [at, is_new] = rendered.try_emplace(count);
    if (is_new) at->second = Table(count).take(knobbly, camera());
    return copy_of(at->second);
  }
  static ViewStore plate_views() {
    static const ViewStore kViews = Table(2).take(kPlate);
    return copy_of(kViews);
  }
  struct Eight {
    Table table{8};
    ViewStore views;
    RegistrationReport report;
  };
  /// Eight views of the knobbly part, registered.
  static const Eight& eight_views() {
    static const Eight kFound = [] {
      Eight found;
      found.views = knobbly_views(8);
      found.report =
          register_views(found.views, camera(), {found.table.given, found.table.stations()});
      return found;
    }();
    return kFound;
  }
};

TEST_F(RegisterViews, FindsTheAxisAndTheAngles) {
  const Table& table = eight_views().table;
  const RegistrationReport& report = eight_views().report;
  EXPECT_LT(axis_error_rad(report.table, table.truth), rad_from_deg(0.01));
  EXPECT_LT(shift_mm(report.table, table.truth), 0.01);
  EXPECT_EQ(report.angles_rad[0], table.angles_rad[0]);
  for (std::size_t i = 0; i < report.angles_rad.size(); ++i) {
    EXPECT_NEAR(report.angles_rad[i], table.true_angles_rad[i], rad_from_deg(0.02)) << i;
  }
  EXPECT_GT(report.rms_before_mm, 5.0 * report.rms_after_mm);
  EXPECT_LT(report.rms_after_mm, 0.035);  // of two points with 0.02 mm each
  EXPECT_GT(report.overlap, 0.5);
  EXPECT_TRUE(report.undetermined.empty()) << report.text();
  EXPECT_LT(report.axis_sigma_mm, 0.01);
  EXPECT_TRUE(report.outliers.empty());
  EXPECT_TRUE(report.trustworthy);
  EXPECT_LT(report.contradiction, 0.01);
  EXPECT_EQ(report.untrusted_reason(), "");
  EXPECT_LT(std::abs(report.closure_after_rad), rad_from_deg(0.02));
  EXPECT_GT(std::abs(report.closure_before_rad), 3.0 * std::abs(report.closure_after_rad));
}

// Each in a process of its own, beside the suite that shares its views.
TEST(RegisterManyViews, FindsTheAxisAndTheAngles) {
  constexpr int kViews = 40;  // more than are compared with each other
  const CameraModel camera = small_camera_model(120, 600.0);
  const Table table(kViews);
  ViewStore views = table.take(knobbly, camera);
  const auto report = register_views(views, camera, {table.given, table.stations()});
  EXPECT_LT(axis_error_rad(report.table, table.truth), rad_from_deg(0.025));  // measured 0.019
  EXPECT_LT(shift_mm(report.table, table.truth), 0.01);
  for (std::size_t i = 0; i < report.angles_rad.size(); ++i)
    EXPECT_NEAR(report.angles_rad[i], table.true_angles_rad[i], rad_from_deg(0.03)) << i;
  EXPECT_LT(std::abs(report.closure_after_rad), rad_from_deg(0.02));
  EXPECT_TRUE(report.outliers.empty());
  EXPECT_TRUE(report.trustworthy);
}

TEST(RegisterManyViews, LeavesOutAMovedView) {
  constexpr int kViews = 12;
  const CameraModel camera = small_camera_model(80, 400.0);
  const Table table(kViews);
  ViewStore views = table.take(knobbly, camera);
  View moved = views.load(9);
  for (float& depth : moved.range.depth_mm.pixels())
    depth -= 2.0F;
  views.replace(9, moved);
  const auto report = register_views(views, camera, {table.given, table.stations()});
  EXPECT_EQ(report.outliers, std::vector<std::size_t>{9});
  EXPECT_LT(shift_mm(report.table, table.truth), 0.02);
}

TEST_F(RegisterViews, LeavesOutAViewWhoseSurfaceContradictsAllOthers) {
  const Table& table = eight_views().table;
  ViewStore views = knobbly_views(8);
  constexpr std::size_t kFaulty = 3;
  View faulty = views.load(kFaulty);
  // Patches of a surface that is not there, in no pose of the view: before the part for the others.
  constexpr int kPatch_px = 8;
  for (int y = 0; y < faulty.range.depth_mm.height(); ++y)
    for (int x = 0; x < faulty.range.depth_mm.width(); ++x)
      if ((x / kPatch_px + y / kPatch_px) % 3 == 0) faulty.range.depth_mm(x, y) -= 6.0F;
  views.replace(kFaulty, faulty);
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  const auto report =
      register_views(views, camera(), {table.given, table.stations()}, RegisterOptions{}, run);
  EXPECT_EQ(report.outliers, (std::vector<std::size_t>{kFaulty}));
  EXPECT_EQ(report.untrusted_reason(), "");
  EXPECT_LT(shift_mm(report.table, table.truth), 0.01);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings.front().find("view 3 "), std::string::npos) << warnings.front();
}

TEST_F(RegisterViews, KeepsAGivenRigThatFitsAsWell) {
  Table table(6, 0.0);
  table.given = table.truth;
  ViewStore views = knobbly_views(6);
  const auto report = register_views(views, camera(), {table.given, table.stations()});
  EXPECT_TRUE(report.kept_rig) << report.text();
  EXPECT_EQ(report.axis_moved_mm(), 0.0);
  EXPECT_EQ(report.largest_turn_rad(), 0.0);
}

TEST_F(RegisterViews, PutsTheViewsInTheRefinedFrame) {
  const Table table(6);
  ViewStore views = knobbly_views(6);
  const auto report = register_views(views, camera(), {table.given, table.stations()});
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto expected = report.table.rig_from_object(report.angles_rad[i]);
    EXPECT_TRUE(views.rig_from_object(i).isApprox(expected));
  }
  // Its origin is the point of the axis that is nearest to the given one.
  EXPECT_NEAR(report.table.axis.dot(table.given.point_mm - report.table.point_mm), 0.0, 1e-9);
}

TEST_F(RegisterViews, LeavesWhatARoundPartDoesNotDetermineToThePrior) {
  const Table table(6);
  const Shape vase = [](const Eigen::Vector3d& p) {
    const double wide = 25.0 + 4.0 * std::sin(0.12 * p.z());
    return 0.8 * std::max(std::hypot(p.x(), p.y()) - wide, std::abs(p.z()) - 30.0);
  };
  ViewStore views = table.take(vase);
  const auto report = register_views(views, small_camera_model(), {table.given, table.stations()});
  ASSERT_EQ(report.undetermined.size(), 1U) << report.text();
  EXPECT_EQ(report.undetermined[0], "the angles of the views");
  for (std::size_t i = 0; i < report.angles_rad.size(); ++i) {
    EXPECT_NEAR(report.angles_rad[i], table.angles_rad[i], rad_from_deg(0.2)) << i;
  }
  EXPECT_LT(axis_error_rad(report.table, table.truth), rad_from_deg(0.03));
}

TEST_F(RegisterViews, ReportsHowWellAnOverlapConstrainsTheAxis) {
  Table table(2);  // opposite sides, which share little but the horizontal top
  const Shape post = [](const Eigen::Vector3d& p) {
    return std::max(std::abs(p.z()) - 30.0, 0.7 * (std::hypot(p.x() / 1.4, p.y()) - 20.0));
  };
  const CameraModel model = small_camera_model(200, 1000.0);
  ViewStore views = table.take(post, model);
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const auto report = register_views(views, model, {table.given, table.stations()}, {}, run);
  EXPECT_GT(report.axis_sigma_mm, 0.05);
  ASSERT_EQ(warnings.size(), 1U) << report.text();
  EXPECT_NE(warnings[0].find("determine the axis only to"), std::string::npos);
}

TEST_F(RegisterViews, KeepsTheRigWithOneView) {
  const Table table(1);
  ViewStore views = knobbly_views(1);
  int warnings = 0;
  frangia::Run run;
  run.on_warning = [&](const std::string&) { ++warnings; };
  const auto report = register_views(views, camera(), {table.given, table.stations()}, {}, run);
  EXPECT_EQ(warnings, 1);
  EXPECT_EQ(report.table.point_mm, table.given.point_mm);
}

TEST_F(RegisterViews, KeepsTheRigWhenViewsDoNotOverlap) {
  const Table table(2);
  ViewStore views = table.take(testing::box({30.0, 30.0, 5.0}));
  View far = views.load(1);
  for (float& depth : far.range.depth_mm.pixels())
    depth += 80.0F;
  views.replace(1, far);
  int warnings = 0;
  frangia::Run run;
  run.on_warning = [&](const std::string&) { ++warnings; };
  const auto report =
      register_views(views, small_camera_model(), {table.given, table.stations()}, {}, run);
  EXPECT_EQ(warnings, 1);
  EXPECT_EQ(report.angles_rad, table.angles_rad);
  EXPECT_FALSE(report.trustworthy);  // the first view lies in front of what the second one measured
}

TEST_F(RegisterViews, CountsTheTurntableWhereNothingVerifiesIt) {
  Table table(2, 0.0);
  table.given = table.truth;
  ViewStore views = plate_views();
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const auto report =
      register_views(views, small_camera_model(), {table.given, table.stations()}, {}, run);
  EXPECT_TRUE(report.rests_on_rig) << report.overlap;
  EXPECT_EQ(report.untrusted_reason(), "");
  EXPECT_FALSE(report.sigma.stated);
  EXPECT_NEAR(report.sigma.point_mm, 0.65, 0.05);  // 1/1000 of the working distance
  ASSERT_EQ(report.motions.size(), 2U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("rest on them alone"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("does not state point_sigma_mm"), std::string::npos) << warnings[0];

  table.given.point_sigma_mm = 0.02;
  table.given.axis_sigma_rad = 1e-4;
  table.given.angle_sigma_rad = 2e-4;
  ViewStore again = plate_views();
  const auto stated =
      register_views(again, small_camera_model(), {table.given, table.stations()}, {}, run);
  EXPECT_TRUE(stated.sigma.stated);
  EXPECT_EQ(stated.sigma.point_mm, 0.02);
  EXPECT_EQ(warnings.back().find("does not state"), std::string::npos) << warnings.back();
  EXPECT_EQ(stated.untrusted_reason(), "");

  table.given.point_sigma_mm = table.given.axis_sigma_rad = table.given.angle_sigma_rad = 0.0;
  ViewStore exact = plate_views();
  static_cast<void>(
      register_views(exact, small_camera_model(), {table.given, table.stations()}, {}, run));
  EXPECT_NE(warnings.back().find("states that they are exact"), std::string::npos)
      << warnings.back();
}

TEST_F(RegisterViews, LeavesLittleOpenWhereViewsOverlap) {
  const RegistrationReport& report = eight_views().report;
  EXPECT_FALSE(report.rests_on_rig);
  ASSERT_EQ(report.motions.size(), 8U);
  for (const auto& motion : report.motions)
    EXPECT_LT((motion - report.motions[0]).bottomRows<3>().norm(), 0.01);
}

TEST_F(RegisterViews, IsNotTrustedWhereALittleOverlapContradictsTheStatedAxis) {
  Table table(2, 0.0);
  // Seen from either side, the top slopes by 0.08 degrees to the other hand.
  const Eigen::AngleAxisd tilt(rad_from_deg(0.08), Eigen::Vector3d::UnitZ());
  table.given.axis = tilt * table.truth.axis;
  table.given.point_mm = table.truth.point_mm;
  table.given.point_sigma_mm = 0.01;
  table.given.axis_sigma_rad = 1e-5;
  table.given.angle_sigma_rad = 1e-5;
  ViewStore views = plate_views();
  const auto report = register_views(views, small_camera_model(), {table.given, table.stations()});
  EXPECT_TRUE(report.rests_on_rig) << report.overlap;
  EXPECT_GT(report.disagreement_over_sigma, 3.0);
  EXPECT_NE(report.untrusted_reason().find("where the views overlap, they disagree by"),
            std::string::npos)
      << report.untrusted_reason();
  table.given.axis_sigma_rad = rad_from_deg(0.08);
  ViewStore again = plate_views();
  const auto fits = register_views(again, small_camera_model(), {table.given, table.stations()});
  EXPECT_LT(fits.disagreement_over_sigma, 2.0);
  EXPECT_EQ(fits.untrusted_reason(), "");
}

TEST_F(RegisterViews, GivesTheSameForAnyNumberOfThreads) {
  const Table table(4);
  const auto find = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ViewStore views = knobbly_views(4);
    return register_views(views, camera(), {table.given, table.stations()});
  };
  const auto one = find(1);
  const auto two = find(2);
  EXPECT_EQ(one.angles_rad, two.angles_rad);
  EXPECT_EQ(one.table.axis, two.table.axis);
}

TEST_F(RegisterViews, RefusesOptionsOutOfRange) {
  const Table table(2);
  ViewStore views = table.take(knobbly, small_camera_model(60, 300.0));
  RegisterOptions options;
  options.relative_reach = 0.0;
  EXPECT_THROW(static_cast<void>(register_views(
                   views, small_camera_model(60, 300.0), {table.given, table.stations()}, options)),
               Error);
}

TEST_F(RegisterViews, RefusesTooFewAngles) {
  const Table table(2);
  ViewStore views = knobbly_views(2);
  const std::vector<Station> angles(1);
  EXPECT_THROW(static_cast<void>(register_views(views, camera(), {table.given, angles})), Error);
}

}  // namespace
}  // namespace frangia
