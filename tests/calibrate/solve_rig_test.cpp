#include "frangia/calibrate/solve_rig.h"

#include <cmath>
#include <map>
#include <string>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "support/board_poses.h"

namespace frangia {
namespace {

using testing::kBoard;
using testing::known_rig;
using testing::make_views;
using testing::TrueRig;

TEST(SolveRig, FindsTheRigThatOpenCvProjectedWith) {
  const TrueRig rig;
  const RigSolution found = solve_rig(kBoard, make_views(rig, 12, 1e-4, 1), known_rig());
  EXPECT_NEAR(found.camera.focal_px.x(), 2400.0, 0.05);
  EXPECT_NEAR(found.camera.principal_point_px.x(), 646.8, 0.05);
  EXPECT_NEAR(found.camera.principal_point_px.y(), 507.4, 0.05);
  EXPECT_NEAR(found.camera.distortion[0], -0.09, 1e-3);
  EXPECT_NEAR(found.camera.distortion[2], 4e-4, 1e-5);
  EXPECT_NEAR(found.projector.focal_px.x(), 1800.0, 0.05);
  EXPECT_NEAR(found.projector.principal_point_px.y(), 420.0, 0.1);
  EXPECT_NEAR(found.projector_from_camera.translation().x(), -190.0, 0.01);
  EXPECT_NEAR(found.projector_from_camera.translation().z(), 40.0, 0.02);
  EXPECT_LT(found.camera_residuals.rms_px, 2e-4);
  EXPECT_TRUE(found.undetermined.empty());
}

/// True value of a parameter by its name in the covariance.
double true_value(const TrueRig& rig, const std::string& name) {
  const bool projector = name.rfind("projector.", 0) == 0;
  const std::string key = name.substr(name.find('.') + 1);
  const cv::Mat& matrix = projector ? rig.projector : rig.camera;
  const cv::Mat& distortion = projector ? rig.projector_distortion : rig.camera_distortion;
  const std::map<std::string, double> values = {{"focal_px", matrix.at<double>(0, 0)},
                                                {"focal_ratio", 1.0},
                                                {"principal_x_px", matrix.at<double>(0, 2)},
                                                {"principal_y_px", matrix.at<double>(1, 2)},
                                                {"k1", distortion.at<double>(0)},
                                                {"k2", distortion.at<double>(1)},
                                                {"p1", distortion.at<double>(2)},
                                                {"p2", distortion.at<double>(3)},
                                                {"k3", distortion.at<double>(4)},
                                                {"rotation_x_rad", rig.rotation.at<double>(0)},
                                                {"rotation_y_rad", rig.rotation.at<double>(1)},
                                                {"rotation_z_rad", rig.rotation.at<double>(2)},
                                                {"x_mm", rig.translation.at<double>(0)},
                                                {"y_mm", rig.translation.at<double>(1)},
                                                {"z_mm", rig.translation.at<double>(2)}};
  return values.at(key);
}

double found_value(const RigSolution& found, const std::string& name) {
  const bool projector = name.rfind("projector.", 0) == 0;
  const std::string key = name.substr(name.find('.') + 1);
  const CameraModel& model = projector ? found.projector : found.camera;
  const Eigen::AngleAxisd turn(found.projector_from_camera.linear());
  const Eigen::Vector3d rotation = turn.angle() * turn.axis();
  const Eigen::Vector3d translation = found.projector_from_camera.translation();
  const std::map<std::string, double> values = {
      {"focal_px", model.focal_px.x()},
      {"focal_ratio", model.focal_px.y() / model.focal_px.x()},
      {"principal_x_px", model.principal_point_px.x()},
      {"principal_y_px", model.principal_point_px.y()},
      {"k1", model.distortion[0]},
      {"k2", model.distortion[1]},
      {"p1", model.distortion[2]},
      {"p2", model.distortion[3]},
      {"k3", model.distortion[4]},
      {"rotation_x_rad", rotation.x()},
      {"rotation_y_rad", rotation.y()},
      {"rotation_z_rad", rotation.z()},
      {"x_mm", translation.x()},
      {"y_mm", translation.y()},
      {"z_mm", translation.z()}};
  return values.at(key);
}

TEST(SolveRig, ErrorsOfFortySeedsAreAsLargeAsTheFullCovarianceStates) {
  const TrueRig rig;
  double squares = 0.0;
  double count = 0.0;
  constexpr unsigned kSeeds = 40;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const RigSolution found = solve_rig(kBoard, make_views(rig, 10, 0.1, seed), known_rig());
    ASSERT_FALSE(found.parameters.empty());
    Eigen::VectorXd error(static_cast<Eigen::Index>(found.parameters.size()));
    for (std::size_t i = 0; i < found.parameters.size(); ++i) {
      const std::string& name = found.parameters[i];
      error[static_cast<Eigen::Index>(i)] = found_value(found, name) - true_value(rig, name);
    }
    squares += error.dot(found.covariance.ldlt().solve(error));
    count += static_cast<double>(error.size());
  }
  const double rms = std::sqrt(squares / count);
  EXPECT_GT(rms, 0.8);
  EXPECT_LT(rms, 1.25);
}

TEST(SolveRig, StatesTheUncertaintyOfAPointThatTheErrorsOfManySeedsHave) {
  const TrueRig rig;
  // A point that both devices see; the found rigs triangulate it from its exact pixels.
  const Eigen::Vector3d point(20.0, -10.0, 480.0);
  const std::vector<cv::Point3d> points = {{point.x(), point.y(), point.z()}};
  const cv::Mat none = cv::Mat::zeros(3, 1, CV_64F);
  std::vector<cv::Point2d> seen;
  std::vector<cv::Point2d> lit;
  cv::projectPoints(points, none, none, rig.camera, rig.camera_distortion, seen);
  cv::projectPoints(
      points, rig.rotation, rig.translation, rig.projector, rig.projector_distortion, lit);
  double squares = 0.0;
  double stated = 0.0;
  constexpr unsigned kSeeds = 12;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const RigSolution found = solve_rig(kBoard, make_views(rig, 10, 0.1, seed), known_rig());
    const Eigen::Vector2d ray = found.camera.ray({seen[0].x, seen[0].y});
    double nearest = 1e9;
    Eigen::Vector3d best = Eigen::Vector3d::Zero();
    for (double z = 470.0; z < 490.0; z += 1e-3) {
      const Eigen::Vector3d tried = z * ray.homogeneous();
      const double gap =
          std::abs(found.projector.project(found.projector_from_camera * tried).x() - lit[0].x);
      if (gap < nearest) {
        nearest = gap;
        best = tried;
      }
    }
    squares += (best - point).squaredNorm() / kSeeds;
    stated += found.point_sigma_mm * found.point_sigma_mm / kSeeds;
  }
  EXPECT_GT(std::sqrt(squares / stated), 0.4);
  EXPECT_LT(std::sqrt(squares / stated), 1.6);
}

TEST(SolveRig, StartsFromTheGivenFocalLengthsButDoesNotTrustWrongOnes) {
  Rig wrong = known_rig();
  wrong.camera.model.focal_px.setConstant(700.0);
  wrong.camera.model.principal_point_px = {640.0, 512.0};
  const RigSolution found = solve_rig(kBoard, make_views({}, 12, 1e-4, 1), wrong);
  EXPECT_NEAR(found.camera.focal_px.x(), 2400.0, 0.05);
}

TEST(SolveRig, NamesTheViewsThatAreTooFew) {
  EXPECT_THROW(static_cast<void>(solve_rig(kBoard, make_views({}, 2, 0.1, 1), known_rig())), Error);
}

}  // namespace
}  // namespace frangia
