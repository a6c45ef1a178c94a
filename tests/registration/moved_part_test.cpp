// Registration of views of a part that was moved between them.
#include <algorithm>
#include <cmath>
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
