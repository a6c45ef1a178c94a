// What the uncertainty of a rig does to sizes and distances, against many rigs that were drawn.
#include "frangia/inspection/calibration_displacements.h"

#include <cmath>
#include <numeric>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/features/find_features.h"
#include "frangia/features/geometric_tolerance.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig_covariance.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/rig_presets.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// Two balls of 30 mm, 70 mm apart, above the turntable.
Mesh two_balls() {
  Mesh mesh = testing::sphere({0.0, -35.0, 40.0}, 15.0, 40);
  const Mesh second = testing::sphere({0.0, 35.0, 40.0}, 15.0, 40);
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.insert(
      mesh.vertices_mm.end(), second.vertices_mm.begin(), second.vertices_mm.end());
  for (const Mesh::Triangle& t : second.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

/// Standard deviations of the parameters of a rig that was calibrated by a board.
RigCovariance covariance_of(const Rig& rig) {
  RigCovariance known{rig_parameter_names(rig), {}};
  Eigen::VectorXd sigma(static_cast<Eigen::Index>(known.parameters.size()));
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    const std::string& name = known.parameters[static_cast<std::size_t>(i)];
    sigma[i] = 1e-4;  // coefficients of distortion, and what is not named below
    if (name.ends_with("_px")) sigma[i] = 0.4;
    if (name.ends_with("_mm")) sigma[i] = 0.05;
    if (name.ends_with("_rad")) sigma[i] = 1e-4;
    if (name.ends_with("_deg")) sigma[i] = 0.006;
  }
  known.covariance = sigma.cwiseAbs2().asDiagonal();
  return known;
}

/// A vertex as one view sees it, in the rig frame.
struct Sight {
  std::size_t vertex = 0;
  double weight = 0.0;
  const Eigen::Isometry3d* pose = nullptr;
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();
};

/// The scan of the balls by a rig whose parameters are those of `truth`, with the rig of the scan:
/// every vertex where the views that face it see it, on average. The rigid motion of all points is
/// removed first, as the registration of the turntable's axis does.
Mesh seen_by(const Rig& truth, const Scan& scan, const Mesh& part) {
  const Pattern& pattern = scan.patterns.back();
  const std::vector<Eigen::Vector3f> normals = vertex_normals(part);
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanView& view : scan.views)
    poses.push_back(scan.rig.rig_from_object(view.angle_rad));
  std::vector<Sight> sights;
  for (std::size_t i = 0; i < part.vertices_mm.size(); ++i) {
    for (const Eigen::Isometry3d& pose : poses) {
      const Eigen::Vector3d point = pose * part.vertices_mm[i].cast<double>();
      const double cosine = -(pose.linear() * normals[i].cast<double>()).dot(point.normalized());
      if (cosine < 0.2) continue;
      const Eigen::Vector2d ray =
          scan.rig.reference().model.ray(truth.reference().model.project(point));
      const double phase = phase_at(point, pattern, truth.projector);
      const RayDepth found = intersect_fringe(ray, phase, pattern, scan.rig.projector);
      sights.push_back({i, cosine * cosine, &pose, found.depth_mm * ray.homogeneous()});
    }
  }
  Eigen::Matrix3Xd from(3, static_cast<Eigen::Index>(sights.size()));
  Eigen::Matrix3Xd to(3, from.cols());
  for (Eigen::Index k = 0; k < from.cols(); ++k) {
    const Sight& sight = sights[static_cast<std::size_t>(k)];
    from.col(k) = sight.seen;
    to.col(k) = *sight.pose * part.vertices_mm[sight.vertex].cast<double>();
  }
  const Eigen::Affine3d placed(Eigen::umeyama(from, to, false));
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(normals.size()));
  std::vector<double> weights(normals.size(), 0.0);
  for (const Sight& sight : sights) {
    sums.col(static_cast<Eigen::Index>(sight.vertex)) +=
        sight.weight * (sight.pose->inverse() * (placed * sight.seen));
    weights[sight.vertex] += sight.weight;
  }
  Mesh seen = part;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0.0)
      seen.vertices_mm[i] = (sums.col(static_cast<Eigen::Index>(i)) / weights[i]).cast<float>();
  }
  return seen;
}

struct Sizes {
  double diameter = 0.0;
  double distance = 0.0;
};

Feature ball_at(const std::vector<Feature>& features, double y) {
  for (const Feature& feature : features) {
    if (feature.fit.shape.kind == ShapeKind::Sphere &&
        std::abs(feature.fit.shape.center_mm.y() - y) < 5.0)
      return feature;
  }
  throw std::runtime_error("the ball is not found");
}

/// Least-squares spheres through the upper parts of the balls, which all views see.
Sizes sizes_of(const Mesh& mesh) {
  FeaturePoints points;
  std::vector<std::uint32_t> chosen[2];
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    const Eigen::Vector3d point = mesh.vertices_mm[i].cast<double>();
    chosen[point.y() > 0.0 ? 1 : 0].push_back(static_cast<std::uint32_t>(i));
    points.points_mm.push_back(point);
  }
  points.normals.assign(points.size(), Eigen::Vector3d::UnitZ());
  Shape fits[2];
  for (int k = 0; k < 2; ++k) {
    const Shape start{.kind = ShapeKind::Sphere,
                      .center_mm = {0.0, k == 0 ? -35.0 : 35.0, 40.0},
                      .radius_mm = 15.0};
    fits[k] = fit_shape(points, chosen[k], start, {.gate_mm = 2.0, .robust = false}).shape;
  }
  return {2.0 * fits[0].radius_mm, (fits[1].center_mm - fits[0].center_mm).norm()};
}

TEST(CalibrationDisplacements, StateWhatManyDrawnRigsDoToSizesAndDistances) {
  Scan scan;
  scan.rig = rig_preset("digital");
  scan.rig.calibration = Calibration{};
  scan.rig.calibration->covariance = covariance_of(scan.rig);
  scan.patterns = default_patterns(scan.rig);
  for (int i = 0; i < 6; ++i)
    scan.views.push_back({kTwoPi * i / 6, {}});
  Mesh part = two_balls();
  part.sigma_mm.assign(part.vertices_mm.size(), 1e-4F);

  const Eigen::MatrixXf displacements = calibration_displacements(part, scan);
  ASSERT_GT(displacements.rows(), 0);
  const auto features = find_features(part, {.edges = false, .calibration_mm = &displacements});
  const Feature first = ball_at(features, -35.0);
  const Feature second = ball_at(features, 35.0);
  const double stated_diameter = first.uncertainty.systematic_mm;
  const MeasuredFeature datum{.feature = second};
  const MeasuredValue spacing = measure(Characteristic::Distance, {.feature = first}, &datum);

  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const RigCovariance& known = scan.rig.calibration->covariance;
  const Eigen::MatrixXd factor = covariance_factor(known);
  double diameter_square = 0.0;
  double distance_square = 0.0;
  constexpr int kDraws = 120;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd z(factor.cols());
    for (double& one : z)
      one = normal(random);
    const Rig truth = change_parameters(scan.rig, known.parameters, factor * z);
    const Sizes sizes = sizes_of(seen_by(truth, scan, part));
    diameter_square += std::pow(sizes.diameter - 30.0, 2) / kDraws;
    distance_square += std::pow(sizes.distance - 70.0, 2) / kDraws;
  }
  // 120 draws: a standard error of 6.5 %.
  EXPECT_NEAR(stated_diameter / std::sqrt(diameter_square), 1.0, 0.2);
  EXPECT_NEAR(spacing.u95 / 1.959964 / std::sqrt(distance_square), 1.0, 0.2);
  // The sum without correlation would be wrong by far.
  EXPECT_GT(std::sqrt(distance_square), 2.0 * std::sqrt(diameter_square));
}

}  // namespace
}  // namespace frangia
