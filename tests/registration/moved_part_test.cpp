// Registration of views of a part that was moved between them.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/registration/register_views.h"

#include "support/misaligned_table.h"

namespace frangia {
namespace {

using testing::knobbly;
using testing::MisalignedTable;
using testing::Shape;
using testing::small_camera_model;

TEST(MovedPart, NamesAndEmptiesAViewOfAMovedPart) {
  const MisalignedTable table(8);
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
  EXPECT_LT(testing::axis_error_rad(report.table, table.truth), rad_from_deg(0.01));
}

TEST(MovedPart, IsNotDistortedByAViewOfAPartThatSlidOnItsFaces) {
  const MisalignedTable table(6);
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
  EXPECT_LT(testing::shift_mm(report.table, table.truth), 0.03);
}

/// Ties of the same points of the part in all views, with noise of 0.01 mm in each coordinate.
std::vector<PointTie> ties_of_points(const std::vector<Eigen::Isometry3d>& rig_from_object) {
  std::mt19937 generator(5);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<PointTie> ties;
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(30.0, 18.0, -14.0),
                                       Eigen::Vector3d(-20.0, 18.0, -14.0),
                                       Eigen::Vector3d(25.0, -18.0, -14.0),
                                       Eigen::Vector3d(-24.0, -15.0, 16.0)}) {
    std::vector<Eigen::Vector3d> seen;
    for (const Eigen::Isometry3d& pose : rig_from_object)
      seen.push_back(pose * point + Eigen::Vector3d::NullaryExpr([&] { return noise(generator); }));
    const Eigen::Matrix3d covariance = 1e-4 * Eigen::Matrix3d::Identity();
    const double share = 2.0 / static_cast<double>(seen.size());
    for (std::size_t from = 0; from < seen.size(); ++from)
      for (std::size_t to = 0; to < from; ++to)
        ties.push_back({from, to, seen[from], seen[to], covariance, covariance, share});
  }
  return ties;
}

TEST(MovedPart, IsPlacedByTheTargetsOfAPartThatSlidOnItsFaces) {
  const MisalignedTable table(8);
  const Shape angle = testing::both(testing::box({34.0, 22.0, 4.0}, {0.0, 0.0, -16.0}),
                                    testing::box({4.0, 22.0, 18.0}, {-26.0, 0.0, 2.0}));
  const Eigen::Vector3d way(0.8, 0.6, 0.0);
  const Shape pushed = [&](const Eigen::Vector3d& p) { return angle(p - way); };
  ViewStore views = table.take(angle);
  std::vector<Eigen::Isometry3d> truth;
  for (std::size_t i = 0; i < 8; ++i) {
    truth.push_back(table.truth.rig_from_object(table.true_angles_rad[i]));
    if (i < 4) continue;
    views.replace(i, testing::snapshot(pushed, small_camera_model(), truth.back()));
    truth.back() = truth.back() * Eigen::Translation3d(way);
  }
  const std::vector<PointTie> ties = ties_of_points(truth);
  const std::vector<Station> stations = table.stations();
  TurntableStations given{table.given, stations};
  given.ties = ties;
  const auto report = register_views(views, small_camera_model(), given);
  EXPECT_EQ(report.explanation.best, PoseCause::PartMoved) << report.text();
  EXPECT_TRUE(report.outliers.empty()) << report.text();
  double squares_mm2 = 0.0;
  for (const PointTie& tie : ties) {
    squares_mm2 += (views.rig_from_object(tie.from).inverse() * tie.from_mm -
                    views.rig_from_object(tie.to).inverse() * tie.to_mm)
                       .squaredNorm();
  }
  const double noise_mm = 0.01 * std::sqrt(2.0 * 3.0);
  EXPECT_LT(std::sqrt(squares_mm2 / static_cast<double>(ties.size())), 1.5 * noise_mm);
}

TEST(MovedPart, IsNotTrustworthyWhenNothingExplainsWhatViewsDisagreeAbout) {
  const MisalignedTable table(6);
  const CameraModel model = small_camera_model(150, 750.0);
  ViewStore views = table.take(knobbly, model);
  for (std::size_t i = 1; i < 6; ++i) {  // every view is pushed, each elsewhere
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
  EXPECT_NE(warnings.back().find("no single cause explains it"), std::string::npos)
      << warnings.back();
  EXPECT_EQ(report.explanation.best, PoseCause::Unexplained) << report.text();
  EXPECT_NE(report.text().find("not trustworthy"), std::string::npos) << report.text();
  EXPECT_EQ(report.untrusted_reason(), warnings.back());
}

}  // namespace
}  // namespace frangia
