#include "frangia/registration/register_views.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "frangia/core/error.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::Shape;
using testing::small_camera_model;

/// The true turntable of a camera that looks down on a part 650 mm away, and the given one.
struct Table {
  Turntable truth{{2.0, 8.0, 650.0}, Eigen::Vector3d(0.03, -0.9, -0.4).normalized()};
  Turntable given = truth;
  std::vector<double> true_angles_rad;
  std::vector<double> angles_rad;

  explicit Table(int views, double angle_noise_rad = rad_from_deg(0.15)) {
    std::mt19937 generator(5);
    std::normal_distribution<double> noise(0.0, angle_noise_rad);
    for (int i = 0; i < views; ++i) {
      true_angles_rad.push_back(kTwoPi * i / views);
      angles_rad.push_back(true_angles_rad.back() + (i == 0 ? 0.0 : noise(generator)));
    }
    given.axis = Eigen::AngleAxisd(rad_from_deg(0.3), Eigen::Vector3d::UnitX()) * truth.axis;
    given.point_mm += Eigen::Vector3d(0.4, 0.2, 0.2);
  }
  [[nodiscard]] std::vector<Station> stations() const {
    std::vector<Station> all;
    for (const double angle : angles_rad)
      all.push_back({angle, ""});
    return all;
  }
  [[nodiscard]] ViewStore take(const Shape& shape,
                               const CameraModel& model = small_camera_model()) const {
    std::vector<Eigen::Isometry3d> poses;
    for (const double angle : true_angles_rad)
      poses.push_back(truth.rig_from_object(angle));
    return testing::snapshots(shape, model, poses);
  }
};

/// A body with bumps and without symmetry.
double knobbly(const Eigen::Vector3d& p) {
  const double bumps =
      std::sin(0.22 * p.x()) * std::sin(0.19 * p.y() + 0.4) * std::sin(0.25 * p.z() + 0.2);
  return 0.6 * (Eigen::Vector3d(p.x() / 1.2, p.y(), p.z()).norm() - 38.0 - 2.0 * bumps);
}

double axis_error_rad(const Turntable& one, const Turntable& other) {
  return std::asin(one.axis.cross(other.axis).norm());
}
double shift_mm(const Turntable& one, const Turntable& other) {
  const Eigen::Vector3d away = one.point_mm - other.point_mm;
  return (away - other.axis * other.axis.dot(away)).norm();
}

TEST(RegisterViews, FindsTheAxisAndTheAngles) {
  const Table table(8);
  ViewStore views = table.take(knobbly);
  const auto report = register_views(views, small_camera_model(), {table.given, table.stations()});
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

TEST(RegisterViews, KeepsAGivenRigThatFitsAsWell) {
  Table table(6, 0.0);
  table.given = table.truth;
  ViewStore views = table.take(knobbly);
  const auto report = register_views(views, small_camera_model(), {table.given, table.stations()});
  EXPECT_TRUE(report.kept_rig) << report.text();
  EXPECT_EQ(report.axis_moved_mm(), 0.0);
  EXPECT_EQ(report.largest_turn_rad(), 0.0);
}

TEST(RegisterViews, PutsTheViewsInTheRefinedFrame) {
  const Table table(6);
  ViewStore views = table.take(knobbly);
  const auto report = register_views(views, small_camera_model(), {table.given, table.stations()});
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto expected = report.table.rig_from_object(report.angles_rad[i]);
    EXPECT_TRUE(views.rig_from_object(i).isApprox(expected));
  }
  // Its origin is the point of the axis that is nearest to the given one.
  EXPECT_NEAR(report.table.axis.dot(table.given.point_mm - report.table.point_mm), 0.0, 1e-9);
}

TEST(RegisterViews, LeavesWhatARoundPartDoesNotDetermineToThePrior) {
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

TEST(RegisterViews, NamesAndEmptiesAViewOfAMovedPart) {
  const Table table(8);
  ViewStore views = table.take(knobbly);
  const Shape pushed = [](const Eigen::Vector3d& p) {
    return knobbly(p - Eigen::Vector3d(4.0, -3.0, 0.0));
  };
  views.replace(
      3,
      testing::snapshot(
          pushed, small_camera_model(), table.truth.rig_from_object(table.true_angles_rad[3])));
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const auto report =
      register_views(views, small_camera_model(), {table.given, table.stations()}, {}, run);
  ASSERT_EQ(report.outliers.size(), 1U);
  EXPECT_EQ(report.outliers[0], 3U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("view 3"), std::string::npos);
  const View emptied = views.load(3);
  const auto depth = emptied.range.depth_mm.pixels();
  EXPECT_TRUE(std::all_of(depth.begin(), depth.end(), [](float z) { return std::isnan(z); }));
  EXPECT_LT(axis_error_rad(report.table, table.truth), rad_from_deg(0.01));
}

TEST(RegisterViews, IsNotDistortedByAViewOfAPartThatSlidOnItsFaces) {
  const Table table(6);
  const Shape angle = testing::both(testing::box({34.0, 22.0, 4.0}, {0.0, 0.0, -16.0}),
                                    testing::box({4.0, 22.0, 18.0}, {-26.0, 0.0, 2.0}));
  const Shape pushed = [&](const Eigen::Vector3d& p) {
    return angle(p - Eigen::Vector3d(0.8, 0.6, 0.0));
  };
  ViewStore views = table.take(angle);
  views.replace(
      1,
      testing::snapshot(
          pushed, small_camera_model(), table.truth.rig_from_object(table.true_angles_rad[1])));
  const auto report = register_views(views, small_camera_model(), {table.given, table.stations()});
  EXPECT_EQ(report.outliers, std::vector<std::size_t>{1});
  EXPECT_LT(shift_mm(report.table, table.truth), 0.03);
}

TEST(RegisterViews, IsNotTrustworthyWhenTooManyViewsContradictEachOther) {
  const Table table(6);
  const CameraModel model = small_camera_model(150, 750.0);
  ViewStore views = table.take(knobbly, model);
  for (const std::size_t i : {1U, 3U, 5U}) {  // every other view is pushed, each elsewhere
    const double way = rad_from_deg(130.0) * static_cast<double>(i);
    const Shape pushed = [&](const Eigen::Vector3d& p) {
      return knobbly(p - Eigen::Vector3d(1.0 * std::cos(way), 1.0 * std::sin(way), 0.8));
    };
    views.replace(
        i, testing::snapshot(pushed, model, table.truth.rig_from_object(table.true_angles_rad[i])));
  }
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  RegisterOptions few;
  few.max_iterations = 10;
  const auto report = register_views(views, model, {table.given, table.stations()}, few, run);
  ASSERT_FALSE(warnings.empty()) << report.text();
  EXPECT_NE(warnings.back().find("contradict each other"), std::string::npos) << warnings.back();
  EXPECT_FALSE(report.trustworthy);
  EXPECT_GT(report.contradiction, few.max_contradiction);
  EXPECT_EQ(report.text().find("agree"), std::string::npos) << report.text();
  EXPECT_NE(report.text().find("not trustworthy"), std::string::npos) << report.text();
  EXPECT_EQ(report.untrusted_reason(), warnings.back());
}

TEST(RegisterViews, ReportsHowWellAnOverlapConstrainsTheAxis) {
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

TEST(RegisterViews, KeepsTheRigWithOneView) {
  const Table table(1);
  ViewStore views = table.take(knobbly);
  int warnings = 0;
  frangia::Run run;
  run.on_warning = [&](const std::string&) { ++warnings; };
  const auto report =
      register_views(views, small_camera_model(), {table.given, table.stations()}, {}, run);
  EXPECT_EQ(warnings, 1);
  EXPECT_EQ(report.table.point_mm, table.given.point_mm);
}

TEST(RegisterViews, KeepsTheRigWhenViewsDoNotOverlap) {
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

TEST(RegisterViews, GivesTheSameForAnyNumberOfThreads) {
  const Table table(4);
  const auto find = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ViewStore views = table.take(knobbly);
    return register_views(views, small_camera_model(), {table.given, table.stations()});
  };
  const auto one = find(1);
  const auto two = find(2);
  EXPECT_EQ(one.angles_rad, two.angles_rad);
  EXPECT_EQ(one.table.axis, two.table.axis);
}

TEST(RegisterViews, RefusesOptionsOutOfRange) {
  const Table table(2);
  ViewStore views = table.take(knobbly, small_camera_model(60, 300.0));
  RegisterOptions options;
  options.relative_reach = 0.0;
  EXPECT_THROW(static_cast<void>(register_views(
                   views, small_camera_model(60, 300.0), {table.given, table.stations()}, options)),
               Error);
}

TEST(RegisterViews, RefusesTooFewAngles) {
  const Table table(2);
  ViewStore views = table.take(knobbly);
  const std::vector<Station> angles(1);
  EXPECT_THROW(
      static_cast<void>(register_views(views, small_camera_model(), {table.given, angles})), Error);
}

}  // namespace
}  // namespace frangia
