#include <array>
#include <cmath>
#include <initializer_list>
#include <random>

#include <gtest/gtest.h>

#include "frangia/registration/internal/assess_fit.h"

#include "support/misaligned_table.h"

namespace frangia {
namespace {

/// Sums with one region for each mean distance.
BundleSums sums_of(std::initializer_list<double> means_mm, std::size_t count) {
  BundleSums sums;
  for (const double mean : means_mm)
    sums.regions.push_back({count, 0, 2.0, 2.0 * mean});
  return sums;
}

Bundle bundle_of_two_views() {
  const Turntable table{{0.0, 0.0, 500.0}, {0.0, -1.0, 0.0}};
  const TableState state{table, {0.0, 1.0}, {}};
  Bundle bundle{{}, FastCameraModel(testing::small_camera_model()), state, state, {}};
  bundle.systematic_mm = 0.002;
  return bundle;
}

TEST(SharedError, IsThatOfTheMeansOfRegionsThatTheUnknownsLeave) {
  const Bundle bundle = bundle_of_two_views();
  ASSERT_EQ(bundle.state.unknowns(), 5);
  const auto sums =
      sums_of({0.01, -0.01, 0.01, -0.01, 0.01, 0.01, -0.01, -0.01, 0.01, -0.01}, 1000);
  EXPECT_NEAR(shared_error_mm(bundle, sums), 0.01 / 0.6745 * std::sqrt(10.0 / 5.0), 1e-5);
}

TEST(SharedError, IsTheOneOfTheOptionsWhereFewRegionsAreCompared) {
  const Bundle bundle = bundle_of_two_views();
  EXPECT_EQ(shared_error_mm(bundle, sums_of({0.01, 0.02, -0.01, 0.03, -0.02}, 1000)), 0.002);
  const auto of_few_pairs = sums_of({0.01, 0.02, -0.01, 0.03, -0.02, 0.01, 0.01, 0.02}, 20);
  EXPECT_EQ(shared_error_mm(bundle, of_few_pairs), 0.002);
}

/// Bends each view by a surface of second order of its own.
void bend(ViewStore& views, double bend_mm) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < views.size(); ++i) {
    View view = views.load(i);
    std::array<double, 5> terms{};
    for (double& term : terms)
      term = bend_mm * normal(generator);
    Image<float>& depth = view.range.depth_mm;
    for (int y = 0; y < depth.height(); ++y) {
      for (int x = 0; x < depth.width(); ++x) {
        const double u = 4.0 * x / depth.width() - 2.0;
        const double v = 4.0 * y / depth.height() - 2.0;
        depth(x, y) += static_cast<float>(terms[0] * u + terms[1] * v + terms[2] * u * v +
                                          terms[3] * (u * u - 1.0) + terms[4] * (v * v - 1.0));
      }
    }
    views.replace(i, view);
  }
}

/// Errors of the places of the views relative to the first one, over what is stated; RMS.
double error_over_stated(const testing::MisalignedTable& table, double bend_mm) {
  const CameraModel camera = testing::small_camera_model(200, 1000.0);
  ViewStore views = table.take(testing::knobbly, camera);
  bend(views, bend_mm);
  const auto report = register_views(views, camera, {table.given, table.stations()});
  EXPECT_FALSE(report.rests_on_rig);
  const auto true_pose = [&](std::size_t i) {
    return table.truth.rig_from_object(table.true_angles_rad[i]);
  };
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 1; i < views.size(); ++i) {
    // Where the two views place a point of the part, in the frame of the rig.
    const Eigen::Isometry3d found = views.rig_from_object(i) * views.rig_from_object(0).inverse();
    const Eigen::Isometry3d truth = true_pose(i) * true_pose(0).inverse();
    const Eigen::Vector3d at = table.truth.point_mm;
    const Eigen::Vector3d error =
        views.rig_from_object(i).rotation().transpose() * (found * at - truth * at);
    const auto moves = report.motions[i] - report.motions[0];
    const Eigen::Vector3d origin = views.rig_from_object(0).inverse() * at;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      Eigen::RowVectorXd stated = moves.row(3 + axis);
      const auto next = (axis + 1) % 3;
      const auto last = (axis + 2) % 3;
      stated += moves.row(next) * origin[last] - moves.row(last) * origin[next];
      sum += std::pow(error[axis], 2) / stated.squaredNorm();
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(AssessPlaces, StatesThePlacesAsWellAsTheViewsAgree) {
  // With the error of the options, 0.0026 mm, the bends would be 10 times what is stated.
  const double ratio = error_over_stated(testing::MisalignedTable(8), 0.03);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 1.6);
}

TEST(AssessPlaces, DoNotBelieveATurntableThatTheViewsContradict) {
  testing::MisalignedTable table(8);
  table.given.point_sigma_mm = 0.0;
  table.given.axis_sigma_rad = 0.0;
  table.given.angle_sigma_rad = 0.0;
  const double ratio = error_over_stated(table, 0.03);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 1.6);
}

TEST(AssessPlaces, TakeThePartPosesFromTheViewsWhereTheAxisRestsOnTheRig) {
  constexpr double kInformation = 1e4;  // 0.01 mm
  Turntable table{{0.0, 0.0, 500.0}, {0.0, -1.0, 0.0}};
  table.point_sigma_mm = table.axis_sigma_rad = table.angle_sigma_rad = 0.0;
  const TableState state{table, {0.0, 1.0}, {0, 1}, {Eigen::Isometry3d::Identity()}};
  Bundle bundle{{}, FastCameraModel(testing::small_camera_model()), state, state, {}};
  bundle.systematic_mm = 0.002;
  bundle.prior_sigma = prior_sigmas(state, {}, 500.0);
  const Eigen::Index unknowns = state.unknowns();
  BundleSums sums;
  sums.hessian = kInformation * Eigen::MatrixXd::Identity(unknowns, unknowns);
  sums.region_gradients = Eigen::MatrixXd::Zero(unknowns, 1);
  sums.distances_mm.assign(100, 0.001F);
  sums.over_sigma.assign(100, 0.67F);
  RegistrationReport report;
  report.given = table;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(unknowns);
  assess_places(report, bundle, sums, {}, Overlap::SaysNothing, none);
  ASSERT_EQ(report.motions.size(), 2U);
  EXPECT_TRUE(report.rests_on_rig);
  EXPECT_LT(report.motions[0].norm(), 1e-9);
  EXPECT_NEAR(report.motions[1].row(3).norm(), 0.01, 0.001);
}

}  // namespace
}  // namespace frangia
