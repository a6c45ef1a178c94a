// Form, orientation, location and run-out against what was built in.
#include "frangia/features/geometric_tolerance.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

#include "features/noisy_shapes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr double kNoise = 0.002;

/// The only feature of its kind in a mesh.
MeasuredFeature only(const Mesh& mesh, ShapeKind kind) {
  for (MeasuredFeature& one : with_points(mesh, find_features(mesh)))
    if (one.feature.fit.shape.kind == kind) return one;
  ADD_FAILURE() << "no " << name_of(kind);
  return {};
}

std::vector<Vector3d> points_of(const Mesh& mesh) {
  std::vector<Vector3d> points;
  for (const auto& vertex : mesh.vertices_mm)
    points.emplace_back(vertex.cast<double>());
  return points;
}

/// A plate of 60 x 40 mm: its height is `bow` times the cross-section of a saddle, and it is
/// tilted.
Mesh plate(double bow_mm, double tilt_rad, double height_mm = 0.0, std::uint64_t seed = 1) {
  Mesh mesh;
  testing::add_patch(mesh, 121, 81, kNoise, seed, [&](double u, double v) {
    const double saddle = 2.0 * (u - 0.5) * (u - 0.5) * 4.0 - 1.0;
    const Vector3d flat(60.0 * (u - 0.5), 40.0 * (v - 0.5), 0.5 * bow_mm * saddle);
    return Vector3d(Eigen::AngleAxisd(tilt_rad, Vector3d::UnitY()) * flat +
                    height_mm * Vector3d::UnitZ());
  });
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), static_cast<float>(kNoise));
  return mesh;
}

/// What another program wrote: the residuals show the noise of the points, and nothing else.
TEST(GeometricTolerance, HasNoUncertaintyWithoutSigma) {
  Mesh mesh = plate(0.0, 0.0);
  const MeasuredFeature known = only(mesh, ShapeKind::Plane);
  mesh.sigma_mm.clear();
  const MeasuredFeature flat = only(mesh, ShapeKind::Plane);
  EXPECT_FALSE(flat.feature.uncertainty.is_known);
  EXPECT_TRUE(std::isnan(flat.feature.uncertainty.u95_mm));
  const MeasuredValue flatness = measure(Characteristic::Flatness, flat);
  EXPECT_NEAR(flatness.value, measure(Characteristic::Flatness, known).value, 1e-3);
  EXPECT_TRUE(std::isnan(flatness.u95));
  // One of two features is enough.
  EXPECT_TRUE(std::isnan(measure(Characteristic::Parallelism, known, &flat).u95));
  EXPECT_TRUE(std::isfinite(measure(Characteristic::Parallelism, known, &known).u95));
}

/// The corners of a decimated mesh are sampled between, and their sigma with them.
TEST(GeometricTolerance, KeepsTheSigmaOfVerticesThatDoNotCoverTheSurface) {
  Mesh box = testing::box({0, 0, 0}, {30, 20, 10});
  box.sigma_mm.assign(box.vertices_mm.size(), 0.01F);
  EXPECT_TRUE(only(box, ShapeKind::Plane).feature.uncertainty.is_known);
  box.sigma_mm.clear();
  EXPECT_FALSE(find_features(box).front().uncertainty.is_known);
}

TEST(GeometricTolerance, FlatnessIsTheBowWithoutTheNoise) {
  const MeasuredFeature flat = only(plate(0.0, 0.1), ShapeKind::Plane);
  const MeasuredValue none = measure(Characteristic::Flatness, flat);
  EXPECT_LT(none.value, 0.004);  // the range of the points is 0.015
  EXPECT_GT(flat.feature.fit.form_mm, 0.012);
  // A bow alone would be found as a cylinder, so the points are given.
  MeasuredFeature bent = flat;
  bent.points_mm = points_of(plate(0.01, 0.1));
  const MeasuredValue bowed = measure(Characteristic::Flatness, bent);
  EXPECT_NEAR(bowed.value, 0.01, 0.003);
  EXPECT_GT(bowed.u95, 0.0);
  EXPECT_LT(bowed.u95, 0.01);
}

/// Errors that are alike over patches of 4 x 4 points look like form. The interval says so.
TEST(GeometricTolerance, CorrelatedErrorsDoNotProveAFormError) {
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Mesh mesh;
    testing::add_patch(mesh, 121, 81, 0.0, 1, [&](double u, double v) {
      const auto patch =
          static_cast<std::uint64_t>(std::lround(120 * u) / 4 * 100 + std::lround(80 * v) / 4);
      const auto own =
          static_cast<std::uint64_t>(std::lround(120 * u) * 1000 + std::lround(80 * v));
      return Vector3d(60.0 * u,
                      40.0 * v,
                      0.002 * normal_from(hash(hash(seed, 1U), patch)) +
                          0.002 * normal_from(hash(hash(seed, 2U), own)));
    });
    MeasuredFeature plane;  // of the frame: the plane z = 0
    plane.points_mm = points_of(mesh);
    const MeasuredValue flat = measure(Characteristic::Flatness, plane);
    covered += flat.value <= flat.u95 ? 1 : 0;  // the surface is flat
  }
  EXPECT_GE(covered, 18);
}

TEST(GeometricTolerance, OrientationIsTheZoneAlongTheDatum) {
  const MeasuredFeature datum = only(plate(0.0, 0.0), ShapeKind::Plane);
  const MeasuredFeature tilted = only(plate(0.0, 0.001, 25.0, 2), ShapeKind::Plane);
  // 60 mm times the tilt, and the noise that remains.
  EXPECT_NEAR(measure(Characteristic::Parallelism, tilted, &datum).value, 0.06, 0.005);
  const MeasuredFeature upright = only(plate(0.0, 0.5 * kPi + 0.001, 0.0, 3), ShapeKind::Plane);
  EXPECT_NEAR(measure(Characteristic::Perpendicularity, upright, &datum).value, 0.06, 0.005);
  const MeasuredValue angle = measure(Characteristic::Angle, tilted, &datum);
  EXPECT_NEAR(angle.value, deg_from_rad(0.001), angle.u95 + 1e-4);
  const MeasuredValue distance = measure(Characteristic::Distance, tilted, &datum);
  EXPECT_NEAR(distance.value, 25.0, distance.u95 + 1e-3);
}

/// A cylinder whose radius has a lobed error and whose axis is off center.
Mesh journal(double radius, double lobe_mm, double eccentric_mm, double base_mm) {
  Mesh mesh;
  testing::add_patch(mesh, 240, 60, kNoise, 7, [&](double u, double v) {
    const double angle = kTwoPi * u;
    const double r = radius + 0.5 * lobe_mm * std::cos(3.0 * angle);
    return Vector3d(eccentric_mm + r * std::cos(angle), r * std::sin(angle), base_mm + 30.0 * v);
  });
  return mesh;
}

TEST(GeometricTolerance, RoundnessAndRunOutFollowTheLobesAndTheEccentricity) {
  const MeasuredFeature datum = only(journal(15.0, 0.0, 0.0, 0.0), ShapeKind::Cylinder);
  const MeasuredFeature lobed = only(journal(20.0, 0.02, 0.0, 40.0), ShapeKind::Cylinder);
  EXPECT_NEAR(measure(Characteristic::Roundness, lobed).value, 0.02, 0.006);
  EXPECT_NEAR(measure(Characteristic::Cylindricity, lobed).value, 0.02, 0.006);
  EXPECT_LT(measure(Characteristic::Cylindricity, datum).value, 0.006);
  const MeasuredFeature eccentric = only(journal(20.0, 0.0, 0.05, 40.0), ShapeKind::Cylinder);
  // Twice the eccentricity.
  EXPECT_NEAR(measure(Characteristic::TotalRunOut, eccentric, &datum).value, 0.1, 0.008);
  EXPECT_NEAR(measure(Characteristic::RunOut, eccentric, &datum).value, 0.1, 0.008);
  const MeasuredValue offset = measure(Characteristic::Distance, eccentric, &datum);
  EXPECT_NEAR(offset.value, 0.05, 0.002);
  EXPECT_NEAR(
      measure(Characteristic::Position, eccentric, nullptr, Vector3d(0, 0, 55)).value, 0.1, 0.004);
  EXPECT_LT(measure(Characteristic::Parallelism, eccentric, &datum).value, 0.004);
}

/// The points on an ideal taper about z: radius 20 - 0.04 to 20 + 0.04 mm over 60 mm.
MeasuredFeature taper(double eccentricity_mm) {
  MeasuredFeature feature;
  feature.feature.fit.shape = {
      ShapeKind::Cylinder, {eccentricity_mm, 0.0, 30.0}, Vector3d::UnitZ(), 20.0, 0.0, 0.0};
  for (int i = 0; i < 240; ++i) {
    for (int k = 0; k <= 60; ++k) {
      const double angle = kTwoPi * i / 240.0;
      const double radius = 20.0 + 0.04 * (k - 30.0) / 30.0;
      feature.points_mm.emplace_back(
          eccentricity_mm + radius * std::cos(angle), radius * std::sin(angle), k);
    }
  }
  return feature;
}

TEST(GeometricTolerance, ATaperIsCylindricityAndTotalRunOutButNotRoundness) {
  MeasuredFeature datum;
  datum.feature.fit.shape = {ShapeKind::Cylinder, Vector3d::Zero(), Vector3d::UnitZ(), 10.0};
  datum.feature.uncertainty.center_u95_mm = 0.0;
  datum.feature.uncertainty.axis_u95_rad = 0.0;
  const MeasuredFeature cone = taper(0.03);
  for (const FormReference fit : {FormReference::LeastSquares, FormReference::MinimumZone}) {
    const auto form = [&](Characteristic kind) {
      return measure(kind, cone, nullptr, Vector3d::Zero(), fit).value;
    };
    EXPECT_NEAR(form(Characteristic::Cylindricity), 0.08, 1e-3);
    // 24 sections of 2.5 mm, each with its share of the taper.
    EXPECT_LT(form(Characteristic::Roundness), 0.08 / 20.0);
  }
  EXPECT_NEAR(measure(Characteristic::TotalRunOut, cone, &datum).value, 0.08 + 0.06, 2e-3);
  EXPECT_NEAR(measure(Characteristic::RunOut, cone, &datum).value, 0.06, 6e-3);
  EXPECT_NEAR(
      measure(Characteristic::Position, cone, nullptr, Vector3d(0.0, 0.04, 7.0)).value, 0.1, 1e-9);
}

TEST(GeometricTolerance, NamesWhatAFeatureDoesNotHave) {
  const MeasuredFeature flat = only(plate(0.0, 0.0), ShapeKind::Plane);
  EXPECT_THROW(static_cast<void>(measure(Characteristic::Roundness, flat)), Error);
  EXPECT_THROW(static_cast<void>(measure(Characteristic::Parallelism, flat)), Error);
  EXPECT_THROW(static_cast<void>(measure(Characteristic::RunOut, flat, &flat)), Error);
}

}  // namespace
}  // namespace frangia
