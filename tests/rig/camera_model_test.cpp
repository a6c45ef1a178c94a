#include "frangia/rig/camera_model.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

const CameraModel kCameraModel{.width_px = 640,
                               .height_px = 512,
                               .focal_px = {1200.0, 1190.0},
                               .principal_point_px = {326.8, 251.4},
                               .distortion = {-0.09, 0.05, 4e-4, -3e-4, 0.01}};

/// Points and pixels of OpenCV 4.6 for one set of coefficients, by tests/rig/make_opencv_points.py.
struct OpenCvModel {
  std::array<double, kDistortionCoefficients> distortion;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector2d>> projected;    ///< point, pixel
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> undistorted;  ///< pixel, ray
};

const std::vector<OpenCvModel>& opencv_models() {
  static const std::vector<OpenCvModel> models{
      {{-0.09, 0.05, 4e-4, -3e-4, 0.01},
       {
           {{0, 0, 250}, {326.80000000000001, 251.40000000000001}},
           {{30, -20, 400}, {416.72391005305178, 191.95223765937135}},
           {{-85, 60, 400}, {73.206091040117826, 428.93089127191752}},
           {{120, 95, 500}, {612.46866478802463, 475.74082312282076}},
           {{-140, -110, 450}, {-41.798281542522034, -35.681069430276835}},
       },
       {
           {{0, 0}, {-0.27509336460855804, -0.21347908268115659}},
           {{326.8, 251.4}, {0, 0}},
           {{639, 511}, {0.26279207632777529, 0.22027530911472351}},
           {{17.25, 480.5}, {-0.26016566668093782, 0.19414967985914972}},
           {{600, 30}, {0.22948310308566566, -0.18754852920133017}},
       }},
      {{-0.31, 0.12, -2e-3, 1.5e-3, -0.02},
       {
           {{0, 0, 250}, {326.80000000000001, 251.40000000000001}},
           {{30, -20, 400}, {416.62689950327149, 192.0047699117261}},
           {{-85, 60, 400}, {77.447082253260447, 425.87126742271772}},
           {{120, 95, 500}, {606.89029158235076, 470.93491379433851}},
           {{-140, -110, 450}, {-29.220095725096655, -26.591115943829124}},
       },
       {
           {{0, 0}, {-0.28323681265430206, -0.21929690400715271}},
           {{326.8, 251.4}, {0, 0}},
           {{639, 511}, {0.26991457757330817, 0.22674524261013701}},
           {{17.25, 480.5}, {-0.26739421690847215, 0.19966483340668892}},
           {{600, 30}, {0.23354410276676457, -0.19078122630104499}},
       }},
      {{0.21, -0.12, 0.0004, -0.0003, 0.03, 0.33, -0.06, 0.02},
       {
           {{0, 0, 250}, {326.80000000000001, 251.40000000000001}},
           {{30, -20, 400}, {416.70155425469227, 191.96701732606459}},
           {{-85, 60, 400}, {73.805881177929592, 428.5110381754493}},
           {{120, 95, 500}, {611.48093544489916, 474.96538699615178}},
           {{-140, -110, 450}, {-39.399861481149173, -33.812300465790457}},
       },
       {
           {{0, 0}, {-0.27643967200172942, -0.21452461418800917}},
           {{326.8, 251.4}, {0, 0}},
           {{639, 511}, {0.26402965973623393, 0.22131193201951357}},
           {{17.25, 480.5}, {-0.26123260361727996, 0.19494573137320362}},
           {{600, 30}, {0.23023767211641838, -0.18816530271268678}},
       }},
      {{-0.12, 0.05, 0.0004, -0.0003, 0.01, 0.02, -0.01, 0.003, 0.001, -0.0002, 0.0005, 0.0001},
       {
           {{0, 0, 250}, {326.80000000000001, 251.40000000000001}},
           {{30, -20, 400}, {416.69715748664089, 191.98120166798984}},
           {{-85, 60, 400}, {74.134298210003976, 428.37800868070718}},
           {{120, 95, 500}, {611.26076405782624, 474.76271448232058}},
           {{-140, -110, 450}, {-38.803385367332282, -33.393272084172594}},
       },
       {
           {{0, 0}, {-0.27691578616637674, -0.2148638002118535}},
           {{326.8, 251.4}, {0, 0}},
           {{639, 511}, {0.26424331653353639, 0.22152789429779804}},
           {{17.25, 480.5}, {-0.26166382682958478, 0.19513339509101846}},
           {{600, 30}, {0.23041651411103428, -0.18842913553296312}},
       }},
      {{-0.12,
        0.05,
        0.0004,
        -0.0003,
        0.01,
        0.02,
        -0.01,
        0.003,
        0.001,
        -0.0002,
        0.0005,
        0.0001,
        0.03,
        -0.05},
       {
           {{0, 0, 250}, {326.80000000000001, 251.40000000000001}},
           {{30, -20, 400}, {417.01281661088649, 191.95444812050007}},
           {{-85, 60, 400}, {75.346544594711133, 427.01397876842861}},
           {{120, 95, 500}, {616.68991227086599, 479.27479032211897}},
           {{-140, -110, 450}, {-31.228545123725951, -27.802069266543555}},
       },
       {
           {{0, 0}, {-0.28236886638365455, -0.2188477000728348}},
           {{326.8, 251.4}, {0, 0}},
           {{639, 511}, {0.25869098337591734, 0.2166595091009911}},
           {{17.25, 480.5}, {-0.26325999857689153, 0.19687479107902839}},
           {{600, 30}, {0.22877093471463555, -0.18757597729157641}},
       }}};
  return models;
}

TEST(CameraModel, ProjectsAsOpenCv) {
  CameraModel model = kCameraModel;
  for (const OpenCvModel& expected : opencv_models()) {
    model.distortion = expected.distortion;
    for (const auto& [point, pixel] : expected.projected)
      EXPECT_LT((model.project(point) - pixel).norm(), 1e-9) << point.transpose();
  }
}

TEST(CameraModel, UndistortsAsOpenCv) {
  CameraModel model = kCameraModel;
  for (const OpenCvModel& expected : opencv_models()) {
    model.distortion = expected.distortion;
    for (const auto& [pixel, ray] : expected.undistorted)
      EXPECT_LT((model.ray(pixel) - ray).norm(), 1e-12) << pixel.transpose();
  }
}

TEST(FastCameraModel, ProjectsAsOpenCv) {
  CameraModel model = kCameraModel;
  for (const OpenCvModel& expected : opencv_models()) {
    model.distortion = expected.distortion;
    const FastCameraModel fast(model);
    for (const auto& [point, pixel] : expected.projected) {
      const Eigen::Vector3f p = point.cast<float>();
      Eigen::Vector2f found;
      fast.project(p.x(), p.y(), p.z(), found.x(), found.y());
      EXPECT_LT((found.cast<double>() - pixel).norm(), 2e-4) << point.transpose();
    }
  }
}

TEST(CameraModel, RayOfAPixelProjectsBackToThePixel) {
  for (int y = 0; y < kCameraModel.height_px; y += 73) {
    for (int x = 0; x < kCameraModel.width_px; x += 61) {
      const Eigen::Vector2d ray = kCameraModel.ray(Eigen::Vector2d(x, y));
      const Eigen::Vector2d pixel = kCameraModel.project({ray.x() * 333.0, ray.y() * 333.0, 333.0});
      EXPECT_NEAR((pixel - Eigen::Vector2d(x, y)).norm(), 0.0, 1e-9);
    }
  }
}

TEST(CameraModel, JacobianIsTheDerivativeOfDistort) {
  const Eigen::Vector2d at(0.21, -0.17);
  const double h = 1e-6;
  CameraModel model = kCameraModel;
  for (const OpenCvModel& each : opencv_models()) {
    model.distortion = each.distortion;
    Eigen::Matrix2d numeric;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
      numeric.col(axis) = (model.distort(at + step) - model.distort(at - step)) / (2.0 * h);
    }
    EXPECT_NEAR((numeric - model.distort_jacobian(at)).norm(), 0.0, 1e-8);
    const auto fast = FastCameraModel(model);
    const auto pixel = model.distortion[5] != 0.0 ? fast.jacobian<true>(0.21F, -0.17F)
                                                  : fast.jacobian<false>(0.21F, -0.17F);
    EXPECT_NEAR(static_cast<double>(pixel.ux), model.focal_px.x() * numeric(0, 0), 2e-3);
    EXPECT_NEAR(static_cast<double>(pixel.uy), model.focal_px.x() * numeric(0, 1), 2e-3);
    EXPECT_NEAR(static_cast<double>(pixel.vx), model.focal_px.y() * numeric(1, 0), 2e-3);
    EXPECT_NEAR(static_cast<double>(pixel.vy), model.focal_px.y() * numeric(1, 1), 2e-3);
  }
}

TEST(CameraModel, HasNoRayWhereTheModelFoldsBack) {
  CameraModel folding = kCameraModel;
  folding.distortion = {-2.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_TRUE(folding.undistort({0.9, 0.0}).hasNaN());
}

TEST(CameraModel, RaysOfMatchesRayAtEveryPixel) {
  CameraModel folding = kCameraModel;  // so strong that the corners of the image have no ray
  folding.distortion[0] = -2.0;
  folding.focal_px = {700.0, 690.0};
  CameraModel tilted = kCameraModel;
  tilted.distortion = opencv_models().back().distortion;
  for (const CameraModel& model : {kCameraModel, folding, tilted}) {
    const auto rays = rays_of(model);
    int missing = 0;
    for (int y = 0; y < model.height_px; y += 3) {
      for (int x = 0; x < model.width_px; x += 3) {
        const Eigen::Vector2d ray = model.ray(Eigen::Vector2d(x, y));
        EXPECT_EQ(rays(x, y).hasNaN(), ray.hasNaN()) << x << ", " << y;
        if (ray.hasNaN()) ++missing;
        if (ray.hasNaN() || rays(x, y).hasNaN()) continue;
        EXPECT_LT((rays(x, y).cast<double>() - ray).norm(), 3e-7) << x << ", " << y;
      }
    }
    EXPECT_EQ(missing > 0, model.distortion[0] < -1.0);
  }
}

}  // namespace
}  // namespace frangia
