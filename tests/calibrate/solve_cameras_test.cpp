// Two cameras and a projector, projected by OpenCV.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/rig/rig_covariance.h"

#include "support/board_poses.h"
#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::kBoard;
using testing::known_rig;
using testing::make_views;
using testing::TrueRig;

/// The projector's place is taken by the second camera, so that OpenCV projects its points, too.
TrueRig with_left_camera() {
  TrueRig rig;
  rig.projector = (cv::Mat_<double>(3, 3) << 2300.0, 0.0, 470.0, 0.0, 2300.0, 390.0, 0.0, 0.0, 1.0);
  rig.projector_distortion = (cv::Mat_<double>(1, 5) << -0.07, 0.0, 0.0, 0.0, 0.0);
  rig.rotation = (cv::Mat_<double>(3, 1) << -0.01, 0.61, 0.02);
  rig.translation = (cv::Mat_<double>(3, 1) << -320.0, -6.0, 90.0);
  return rig;
}

Rig known_cameras() {
  Rig rig = known_rig();
  PosedCamera left;
  left.camera = rig.reference();
  left.camera.name = "left";
  left.camera.model.width_px = 960;
  left.camera.model.height_px = 768;
  left.position_mm.setConstant(std::nan(""));
  left.rotation.setConstant(std::nan(""));
  rig.cameras.push_back(left);
  return rig;
}

/// Poses seen by both cameras, with noise in all pixels.
std::vector<BoardView> views_of_both(double noise_px, unsigned seed) {
  constexpr int kPoses = 10;
  std::vector<BoardView> views = make_views({}, kPoses, 0.0, seed);
  const std::vector<BoardView> left = make_views(with_left_camera(), kPoses, 0.0, seed);
  std::mt19937 random(1000 + seed);
  std::normal_distribution<double> normal(0.0, noise_px);
  const auto shake = [&](std::vector<BoardPoint>& points) {
    for (BoardPoint& point : points) {
      for (Eigen::Vector2d* pixel : {&point.camera_px, &point.projector_px})
        *pixel += Eigen::Vector2d(normal(random), normal(random));
    }
  };
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<BoardPoint>& points = views[i].more.emplace_back(views[i].points);
    for (std::size_t k = 0; k < points.size(); ++k)
      points[k].camera_px = left[i].points[k].projector_px;
    if (noise_px == 0.0) continue;
    shake(views[i].points);
    shake(points);
  }
  return views;
}

Rig true_cameras() {
  const auto model_of =
      [](const cv::Mat& matrix, const cv::Mat& distortion, int width, int height) {
        CameraModel model{.width_px = width, .height_px = height};
        model.focal_px = {matrix.at<double>(0, 0), matrix.at<double>(1, 1)};
        model.principal_point_px = {matrix.at<double>(0, 2), matrix.at<double>(1, 2)};
        for (int i = 0; i < 5; ++i)
          model.distortion.at(static_cast<std::size_t>(i)) = distortion.at<double>(i);
        return model;
      };
  const auto place = [](const TrueRig& from, Eigen::Matrix3d& rotation, Eigen::Vector3d& position) {
    const Eigen::Vector3d turn(
        from.rotation.at<double>(0), from.rotation.at<double>(1), from.rotation.at<double>(2));
    rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    position = -(rotation.transpose() * Eigen::Vector3d(from.translation.at<double>(0),
                                                        from.translation.at<double>(1),
                                                        from.translation.at<double>(2)));
  };
  const TrueRig right;
  const TrueRig left = with_left_camera();
  Rig rig = known_cameras();
  rig.reference().model = model_of(right.camera, right.camera_distortion, 1280, 1024);
  rig.projector.model = model_of(right.projector, right.projector_distortion, 1280, 800);
  place(right, rig.projector.rotation, rig.projector.position_mm);
  rig.cameras[1].camera.model = model_of(left.projector, left.projector_distortion, 960, 768);
  place(left, rig.cameras[1].rotation, rig.cameras[1].position_mm);
  return rig;
}

/// Error of a solution in its covariance's parameters: the change of the true rig that gives it.
Eigen::VectorXd errors_of(const RigSolution& found, const Rig& truth) {
  const auto intrinsics = [](const CameraModel& model) {
    Eigen::VectorXd out(9);
    out << model.focal_px.x(), model.focal_px.y() / model.focal_px.x(), model.principal_point_px,
        Eigen::Map<const Eigen::Matrix<double, 5, 1>>(model.distortion.data());
    return out;
  };
  const auto pose = [](const Eigen::Isometry3d& isometry) {
    const Eigen::AngleAxisd turn(isometry.linear());
    Eigen::VectorXd out(6);
    out << turn.angle() * turn.axis(), isometry.translation();
    return out;
  };
  Eigen::Isometry3d projector = Eigen::Isometry3d::Identity();
  projector.linear() = truth.projector.rotation;
  projector.translation() = -(truth.projector.rotation * truth.projector.position_mm);
  const bool lit = found.has_projector;
  Eigen::VectorXd out(lit ? 39 : 24);
  out.head<9>() = intrinsics(found.reference().model) - intrinsics(truth.reference().model);
  if (lit) {
    out.segment<9>(9) =
        intrinsics(found.projector) - intrinsics(std::get<PinholeModel>(truth.projector.model));
    out.segment<6>(18) = pose(found.projector_from_camera) - pose(projector);
  }
  out.segment<9>(lit ? 24 : 9) =
      intrinsics(found.cameras[1].model) - intrinsics(truth.cameras[1].camera.model);
  out.tail<6>() = pose(found.cameras[1].camera_from_rig) - pose(truth.cameras[1].camera_from_rig());
  return out;
}

/// RMS of the errors of many seeds, normalized by the full covariance.
double normalized_error(const Rig& known, const Rig& truth) {
  double squares = 0.0;
  double count = 0.0;
  constexpr unsigned kSeeds = 8;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const RigSolution found = solve_rig(kBoard, views_of_both(0.1, seed), known);
    const Eigen::VectorXd error = errors_of(found, truth);
    EXPECT_EQ(static_cast<Eigen::Index>(found.parameters.size()), error.size());
    squares += error.dot(found.covariance.ldlt().solve(error));
    count += static_cast<double>(error.size());
  }
  return std::sqrt(squares / count);
}

TEST(SolveCameras, ErrorsAreAsLargeAsTheFullCovarianceStates) {
  const double rms = normalized_error(known_cameras(), true_cameras());
  EXPECT_GT(rms, 0.8);
  EXPECT_LT(rms, 1.25);
}

TEST(SolveCameras, NeedNoModelOfAProjectorThatLabelsPoints) {
  Rig label = known_cameras();
  label.projector.is_label = true;
  const double rms = normalized_error(label, true_cameras());
  EXPECT_GT(rms, 0.8);
  EXPECT_LT(rms, 1.25);
}

TEST(SolveCameras, NamesTheParametersOfEachCamera) {
  const RigSolution found = solve_rig(kBoard, views_of_both(1e-4, 3), known_cameras());
  EXPECT_EQ(found.parameters, rig_parameter_names(true_cameras()));
  EXPECT_EQ(found.parameters.back(), "camera-left.z_mm");
  const Rig moved = change_parameters(
      true_cameras(), {"camera-left.z_mm", "camera-left.focal_px"}, Eigen::Vector2d(2.0, 5.0));
  EXPECT_NEAR(moved.cameras[1].camera_from_rig().translation().z(), 92.0, 1e-9);
  EXPECT_NEAR(moved.cameras[1].camera.model.focal_px.y(), 2305.0, 1e-9);
  EXPECT_EQ(moved.reference().model.focal_px, true_cameras().reference().model.focal_px);
}

TEST(SolveCameras, APoseThatOneCameraMissesStillServesTheOthers) {
  std::vector<BoardView> views = views_of_both(1e-4, 3);
  views[2].more[0].clear();
  const RigSolution found = solve_rig(kBoard, views, known_cameras());
  EXPECT_EQ(found.cameras[1].by_view[2].points, 0U);
  EXPECT_GT(found.reference().by_view[2].points, 0U);
  EXPECT_NEAR(found.cameras[1].camera_from_rig.translation().x(), -320.0, 0.01);
  for (std::size_t i = 2; i < views.size(); ++i)
    views[i].more[0].clear();
  const std::string fault =
      error_of([&] { static_cast<void>(solve_rig(kBoard, views, known_cameras())); });
  EXPECT_NE(fault.find("camera \"left\" sees the board in 2 of the poses"), std::string::npos)
      << fault;
}

}  // namespace
}  // namespace frangia
