#include "frangia/range/calibration_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/camera_model.h"
#include "frangia/rig/paper_rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

const Pattern kFringe{.name = "fringe", .fringes_per_degree = 1.0};
const Pattern kColumns{.name = "columns", .period_px = 20.0};

Rig digital_rig() {
  Rig rig = make_paper_rig({});
  rig.reference().model.distortion = {-0.09, 0.05, 4e-4, -3e-4, 0.0};
  CameraModel projector;
  projector.width_px = 1280;
  projector.height_px = 800;
  projector.focal_px = {2200.0, 2200.0};
  projector.principal_point_px = {640.0, 400.0};
  projector.distortion = {0.03, -0.02, 0.0, 0.0, 0.0};
  rig.projector.model = projector;
  return rig;
}

/// A covariance with the given standard deviations and correlations drawn at random.
RigCovariance correlated(std::vector<std::string> names, const Eigen::VectorXd& sigma) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const Eigen::Index count = sigma.size();
  Eigen::MatrixXd root(count, count + 2);
  for (double& value : root.reshaped())
    value = normal(generator);
  root.rowwise().normalize();
  root = sigma.asDiagonal() * root;
  return {std::move(names), root * root.transpose()};
}

RigCovariance digital_covariance() {
  Eigen::VectorXd sigma(24);
  sigma << 0.8, 1e-4, 1.0, 1.0, 2e-3, 1e-2, 1e-4, 1e-4, 1e-2,  // camera
      1.2, 1e-4, 1.5, 1.5, 3e-3, 2e-2, 1e-4, 1e-4, 2e-2,       // projector
      4e-4, 5e-4, 3e-4, 0.1, 0.1, 0.2;                         // relative pose
  return correlated(rig_parameter_names(digital_rig()), sigma);
}

/// Points of a wavy surface that fills the measuring volume of the paper's rig.
std::vector<Vector3d> measured_points() {
  std::vector<Vector3d> points;
  for (int i = -7; i <= 7; ++i) {
    for (int j = -7; j <= 7; ++j)
      points.emplace_back(9.0 * i, 9.0 * j, 490.0 + 30.0 * std::sin(0.6 * i) * std::cos(0.5 * j));
  }
  return points;
}

/// Where a rig sees the point that another one, the true one, sees at the same pixel.
using SeenBy = std::function<Vector3d(const Rig& rig, const Vector3d& point)>;

/// Reference camera and projector.
SeenBy by_projector(const Rig& truth, const Pattern& pattern) {
  return [&truth, &pattern](const Rig& rig, const Vector3d& point) {
    const Eigen::Vector2d ray = rig.reference().model.ray(truth.reference().model.project(point));
    const double phase = phase_at(point, pattern, truth.projector);
    return Vector3d(intersect_fringe(ray, phase, pattern, rig.projector).depth_mm *
                    ray.homogeneous());
  };
}

/// The point on the first camera's ray that the second one sees nearest to its pixel, by search.
SeenBy by_second_camera(const Rig& truth) {
  return [&truth](const Rig& rig, const Vector3d& point) {
    const PosedCamera& nominal = truth.cameras.at(1);
    const PosedCamera& second = rig.cameras.at(1);
    const Eigen::Vector2d pixel = nominal.camera.model.project(nominal.camera_from_rig() * point);
    const Eigen::Vector2d ray = rig.reference().model.ray(truth.reference().model.project(point));
    double low = 0.8 * point.z();
    double high = 1.25 * point.z();
    for (int i = 0; i < 90; ++i) {
      const auto off = [&](double depth) {
        const Vector3d there = second.camera_from_rig() * Vector3d(depth * ray.homogeneous());
        return (second.camera.model.project(there) - pixel).squaredNorm();
      };
      const double a = low + (high - low) / 3.0;
      const double b = high - (high - low) / 3.0;
      (off(a) < off(b) ? high : low) = off(a) < off(b) ? b : a;
    }
    return Vector3d(0.5 * (low + high) * ray.homogeneous());
  };
}

/// The RMS over rigs drawn from the covariance of the distance along its ray by which each point
/// moves, after the best rigid motion (Umeyama 1991) of all points. The rays begin at `eye`.
std::vector<double> scatter_of(const Rig& rig,
                               const SeenBy& seen_by,
                               const std::vector<Vector3d>& points,
                               int draws,
                               const Vector3d& eye = Vector3d::Zero()) {
  const RigCovariance& known = rig.calibration->covariance;
  const Eigen::LLT<Eigen::MatrixXd> root(known.covariance);
  const Eigen::MatrixXd lower = root.matrixL();
  std::mt19937 generator(9);
  std::normal_distribution<double> normal;
  std::vector<double> squares(points.size(), 0.0);
  Eigen::Matrix3Xd nominal(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    nominal.col(static_cast<Eigen::Index>(i)) = points[i];
  for (int draw = 0; draw < draws; ++draw) {
    const Eigen::VectorXd z =
        Eigen::VectorXd::NullaryExpr(lower.cols(), [&] { return normal(generator); });
    const Rig other = change_parameters(rig, known.parameters, lower * z);
    Eigen::Matrix3Xd seen = nominal;
    for (std::size_t i = 0; i < points.size(); ++i)
      seen.col(static_cast<Eigen::Index>(i)) = seen_by(other, points[i]);
    const Eigen::Matrix4d motion = Eigen::umeyama(nominal, seen, false);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d moved =
          motion.topLeftCorner<3, 3>() * points[i] + motion.topRightCorner<3, 1>();
      const double along =
          (seen.col(static_cast<Eigen::Index>(i)) - moved).dot((points[i] - eye).normalized());
      squares[i] += along * along / draws;
    }
  }
  for (double& square : squares)
    square = std::sqrt(square);
  return squares;
}

void expect_scatter(const Rig& rig,
                    const Pattern& pattern,
                    const SeenBy& seen_by,
                    std::size_t camera = 0) {
  const std::vector<Vector3d> points = measured_points();
  const CalibrationUncertainty stated(rig, pattern, {.points_mm = points, .shared = {}}, camera);
  const Eigen::Isometry3d camera_from = rig.cameras[camera].camera_from_rig();
  const CameraModel& model = rig.cameras[camera].camera.model;
  const std::vector<double> scatter =
      scatter_of(rig, seen_by, points, 800, camera_from.inverse().translation());
  double stated_squares = 0.0;
  double scatter_squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d point = camera_from * points[i];
    const Eigen::Vector2d pixel = model.project(point);
    const double sigma = stated.along_ray_mm(point, pixel);
    EXPECT_NEAR(sigma / scatter[i], 1.0, 0.1) << points[i].transpose();
    stated_squares += sigma * sigma;
    scatter_squares += scatter[i] * scatter[i];
  }
  EXPECT_NEAR(std::sqrt(stated_squares / scatter_squares), 1.0, 0.05);
}

TEST(CalibrationUncertainty, IsTheScatterOfRigsDrawnFromTheCovarianceOfADigitalRig) {
  Rig rig = digital_rig();
  rig.calibration = Calibration{.covariance = digital_covariance()};
  expect_scatter(rig, kColumns, by_projector(rig, kColumns));
}

TEST(CalibrationUncertainty, IsTheScatterOfRigsDrawnFromTheCovarianceOfAnAngularRig) {
  Rig rig = make_paper_rig({});
  Eigen::VectorXd sigma(16);
  sigma << 0.5, 1e-4, 0.8, 0.8, 2e-3, 1e-2, 1e-4, 1e-4, 1e-2, 3e-4, 4e-4, 3e-4, 0.1, 0.1, 0.2, 5e-4;
  rig.calibration = Calibration{.covariance = correlated(rig_parameter_names(rig), sigma)};
  expect_scatter(rig, kFringe, by_projector(rig, kFringe));
}

/// The digital rig with a second camera 150 mm beside the first.
Rig two_camera_rig() {
  Rig rig = digital_rig();
  PosedCamera second;
  second.camera = rig.reference();
  second.camera.name = "left";
  second.position_mm = {150.0, 4.0, 20.0};
  second.rotation =
      (Eigen::AngleAxisd(0.3, Vector3d::UnitY()) * Eigen::AngleAxisd(0.02, Vector3d::UnitX()))
          .toRotationMatrix();
  rig.cameras.push_back(second);
  Eigen::VectorXd sigma(39);
  sigma << digital_covariance().covariance.diagonal().cwiseSqrt(),  // camera, projector, pose
      0.9, 1e-4, 1.1, 0.9, 3e-3, 1e-2, 1e-4, 1e-4, 1e-2,            // second camera
      3e-4, 4e-4, 2e-4, 0.1, 0.1, 0.15;                             // its pose
  rig.calibration = Calibration{.covariance = correlated(rig_parameter_names(rig), sigma)};
  return rig;
}

TEST(CalibrationUncertainty, IsTheScatterOfTwoCamerasWithAProjectorThatIsALabel) {
  Rig rig = two_camera_rig();
  rig.projector.is_label = true;
  expect_scatter(rig, kColumns, by_second_camera(rig));
}

TEST(CalibrationUncertainty, IsTheScatterOfASecondCameraAndTheProjector) {
  const Rig truth = two_camera_rig();
  const SeenBy search = [&](const Rig& rig, const Vector3d& point) {
    const PosedCamera& nominal = truth.cameras.at(1);
    const PosedCamera& second = rig.cameras.at(1);
    const Eigen::Vector2d pixel = nominal.camera.model.project(nominal.camera_from_rig() * point);
    const Vector3d direction =
        second.rotation.transpose() * second.camera.model.ray(pixel).homogeneous();
    const double phase = phase_at(point, kColumns, truth.projector);
    const double depth = (nominal.camera_from_rig() * point).z();
    double low = 0.8 * depth;
    double high = 1.25 * depth;
    const auto off = [&](double at) {
      return phase_at(second.position_mm + at * direction, kColumns, rig.projector) - phase;
    };
    const bool rises = off(high) > off(low);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((off(middle) > 0.0) == rises ? high : low) = middle;
    }
    return Vector3d(second.position_mm + 0.5 * (low + high) * direction);
  };
  expect_scatter(truth, kColumns, search, 1);
}

TEST(CalibrationUncertainty, IsZeroForAChangeThatLeavesThePlanesOfLightWhereTheyAre) {
  Rig rig = digital_rig();
  std::get<PinholeModel>(rig.projector.model).distortion = {};
  rig.calibration =
      Calibration{.covariance = {{"projector.y_mm"}, Eigen::MatrixXd::Constant(1, 1, 4.0)}};
  const CalibrationUncertainty none(rig, kColumns, {.points_mm = measured_points(), .shared = {}});
  EXPECT_LT(none.along_ray_mm({0.0, 0.0, 490.0}, rig.reference().model.project({0.0, 0.0, 490.0})),
            1e-6);
}

TEST(CalibrationUncertainty, ExcludesTheRigidMotionOfThePart) {
  // What remains of a displacement is strain, so a part of 1/50 of the size has 1/50 of it.
  Rig rig = digital_rig();
  rig.calibration = Calibration{
      .covariance = {{"projector.rotation_y_rad"}, Eigen::MatrixXd::Constant(1, 1, 1e-6)}};
  const auto largest_mm = [&](double scale) {
    const Vector3d center(0.0, 0.0, 490.0);
    std::vector<Vector3d> points = measured_points();
    for (Vector3d& point : points)
      point = center + scale * (point - center);
    const CalibrationUncertainty stated(rig, kColumns, {.points_mm = points, .shared = {}});
    double largest = 0.0;
    for (const Vector3d& point : points) {
      const Eigen::Vector2d pixel = rig.reference().model.project(point);
      largest = std::max(largest, stated.along_ray_mm(point, pixel));
    }
    return largest;
  };
  const double of_large = largest_mm(1.0);
  EXPECT_GT(of_large, 0.01);
  EXPECT_LT(largest_mm(0.02), 0.04 * of_large);
}

/// A ball of 30 mm radius on the axis, seen at eight stations.
MeasuredVolume ball_at_eight_stations(const Vector3d& center) {
  MeasuredVolume volume;
  const auto seen = [&](const Vector3d& direction, int station) {
    return Vector3d(Eigen::AngleAxisd(station * M_PI / 4.0, Vector3d::UnitY()) * direction);
  };
  const auto faces = [&](const Vector3d& normal) {
    return -normal.dot((center + 30.0 * normal).normalized()) > 0.2;
  };
  for (int i = 0; i < 400; ++i) {
    const double y = (i + 0.5) / 200.0 - 1.0;  // Fibonacci's lattice
    const double turn = 2.399963 * i;
    const double across = std::sqrt(1.0 - y * y);
    const Vector3d direction(across * std::cos(turn), y, across * std::sin(turn));
    for (int station = 0; station < 8; ++station) {
      const Vector3d first = seen(direction, station);
      const Vector3d second = seen(direction, station + 1);
      if (!faces(first)) continue;
      volume.points_mm.emplace_back(center + 30.0 * first);
      if (faces(second))
        volume.shared.push_back({center + 30.0 * first, first, center + 30.0 * second, second});
    }
  }
  return volume;
}

TEST(CalibrationUncertainty, HoldsTheSizeOfAPartWhoseViewsAgreeAboutTheAxis) {
  // A longer baseline enlarges everything about the camera's centre. The views agree when the axis
  // moves along, and the part has become larger about the axis: by 0.2 % of 30 mm.
  Rig rig = digital_rig();
  const Vector3d baseline = rig.projector.rotation * rig.projector.position_mm;
  constexpr double kScale = 0.002;
  rig.calibration =
      Calibration{.covariance = {{"projector.x_mm", "projector.y_mm", "projector.z_mm"},
                                 kScale * kScale * baseline * baseline.transpose()}};
  const Vector3d center(0.0, 0.0, 490.0);
  MeasuredVolume volume = ball_at_eight_stations(center);
  const auto nearest_mm = [&] {
    const CalibrationUncertainty stated(rig, kColumns, volume);
    const Eigen::Vector2d pixel = rig.reference().model.project(center);
    return stated.along_ray_mm({0.0, 0.0, 460.0}, pixel);
  };
  EXPECT_NEAR(nearest_mm(), kScale * 30.0, 0.05 * kScale * 30.0);
  // All of the ball has become larger: along inclined rays the surface moves further.
  const Image<Eigen::Vector2f> rays = rays_of(rig.reference().model);
  Image<float> depth_mm(rays.width(), rays.height(), kMissing);
  Image<double> cosines(rays.width(), rays.height(), 0.0);
  for (int y = 0; y < rays.height(); ++y) {
    for (int x = 0; x < rays.width(); ++x) {
      const Vector3d ray = rays(x, y).cast<double>().homogeneous().normalized();
      const double nearest = ray.dot(center);
      const double inside = 900.0 - (center - nearest * ray).squaredNorm();
      if (!(inside > 0.0)) continue;
      const Vector3d point = (nearest - std::sqrt(inside)) * ray;
      depth_mm(x, y) = static_cast<float>(point.z());
      cosines(x, y) = -ray.dot((point - center).normalized());
    }
  }
  const Image<float> along =
      CalibrationUncertainty(rig, kColumns, volume).along_rays_mm(depth_mm, rays);
  for (int y = 0; y < rays.height(); y += 5) {
    for (int x = 0; x < rays.width(); x += 5) {
      if (cosines(x, y) < 0.4) continue;
      EXPECT_NEAR(along(x, y) * cosines(x, y), kScale * 30.0, 0.1 * kScale * 30.0)
          << x << " " << y << " " << cosines(x, y);
    }
  }
  // A single view has no axis: its displacement is that relative to the rest of what it sees.
  volume.shared.clear();
  EXPECT_LT(nearest_mm(), 0.6 * kScale * 30.0);
}

TEST(CalibrationUncertainty, IsThatOfEachPointOfAGrid) {
  Rig rig = digital_rig();
  rig.calibration = Calibration{.covariance = digital_covariance()};
  const CalibrationUncertainty stated(
      rig, kColumns, {.points_mm = measured_points(), .shared = {}});
  Image<float> depth_mm(512, 512, 495.0F);
  depth_mm(100, 200) = kMissing;
  const Image<float> along = stated.along_rays_mm(depth_mm, rays_of(rig.reference().model));
  EXPECT_TRUE(std::isnan(along(100, 200)));
  // A plane across the axis of the camera: there, the ray is the normal.
  const Eigen::Vector2d middle = rig.reference().model.project({0.0, 0.0, 495.0});
  const float there =
      along(static_cast<int>(std::lround(middle.x())), static_cast<int>(std::lround(middle.y())));
  EXPECT_NEAR(there, stated.along_ray_mm({0.0, 0.0, 495.0}, middle), 0.01F * there);
  EXPECT_GT(there, 0.001F);
}

TEST(CalibrationUncertainty, SaysNothingWithoutACovariance) {
  const CalibrationUncertainty stated(
      digital_rig(), kColumns, {.points_mm = measured_points(), .shared = {}});
  const Image<Eigen::Vector2f> rays(8, 8, Eigen::Vector2f::Zero());
  EXPECT_TRUE(stated.along_rays_mm(Image<float>(8, 8, 495.0F), rays).empty());
}

}  // namespace
}  // namespace frangia
