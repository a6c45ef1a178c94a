#include "frangia/features/measure_picked.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "features/noisy_shapes.h"
#include "support/error_of.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::add_patch;

constexpr double kNoise_mm = 0.01;

/// A plate of 40 x 30 x 8 mm without side walls, a separate wedge of 30 degrees, and a hole of 12
/// mm centred on (60, 0) with its axis along z.
Mesh part(std::uint64_t seed = 1, double noise_mm = kNoise_mm) {
  Mesh mesh;
  add_patch(mesh, 80, 60, noise_mm, seed, [](double u, double v) {
    return Vector3d(40.0 * u, 30.0 * v, 8.0);
  });
  add_patch(mesh, 60, 80, noise_mm, seed + 1, [](double u, double v) {
    return Vector3d(40.0 * v, 30.0 * u, 0.0);
  });
  add_patch(mesh, 60, 60, noise_mm, seed + 2, [](double u, double v) {
    return Vector3d(40.0 * u,
                    50.0 + 25.0 * v * std::cos(rad_from_deg(30.0)),
                    25.0 * v * std::sin(rad_from_deg(30.0)));
  });
  add_patch(mesh, 40, 120, noise_mm, seed + 3, [](double u, double v) {
    const double angle = kTwoPi * v;
    return Vector3d(60.0 + 6.0 * std::cos(angle), 6.0 * std::sin(angle), 20.0 * u);
  });
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), static_cast<float>(noise_mm));
  return mesh;
}

/// The triangle whose center is nearest to a point, as a place there.
PickedPlace at(const Mesh& mesh, const Vector3d& point, bool face) {
  PickedPlace place{.face = face};
  double nearest = 1e9;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Vector3d center = Vector3d::Zero();
    for (const std::uint32_t vertex : mesh.triangles[t])
      center += mesh.vertices_mm[vertex].cast<double>() / 3.0;
    const double away = (center - point).norm();
    if (away >= nearest) continue;
    nearest = away;
    place.triangle = t;
    place.point_mm = center;
  }
  return place;
}

PickedMeasurement measured(const Mesh& mesh,
                           PickedQuantity quantity,
                           const std::vector<PickedPlace>& places) {
  return measure_picked(mesh, quantity, places);
}

TEST(MeasurePicked, PointsAreAsFarApartAsTheyAre) {
  const Mesh mesh = part();
  const auto a = at(mesh, {5, 5, 8}, false);
  const auto b = at(mesh, {35, 25, 8}, false);
  const auto found = measured(mesh, PickedQuantity::Distance, {a, b});
  EXPECT_NEAR(found.value, (b.point_mm - a.point_mm).norm(), 1e-9);
  EXPECT_EQ(found.from_mm, a.point_mm);
  EXPECT_EQ(found.to_mm, b.point_mm);
  EXPECT_NEAR(found.u95, 1.96 * std::sqrt(2.0) * kNoise_mm, 1e-4);
}

TEST(MeasurePicked, FacesAreFarMoreCertainThanPoints) {
  const Mesh mesh = part();
  const auto found = measured(
      mesh, PickedQuantity::Distance, {at(mesh, {7, 9, 8}, true), at(mesh, {30, 20, 0}, true)});
  EXPECT_NEAR(found.value, 8.0, 0.002);
  EXPECT_LT(std::abs(found.value - 8.0), 2.0 * found.u95);
  EXPECT_LT(found.u95, 0.3 * 1.96 * kNoise_mm);
  EXPECT_EQ(found.elements[0].feature.fit.shape.kind, ShapeKind::Plane);
  EXPECT_NEAR((found.to_mm - found.from_mm).norm(), found.value, 1e-6);
  EXPECT_NEAR(found.to_mm.z() - found.from_mm.z(), -8.0, 0.002);
}

TEST(MeasurePicked, U95OfAFaceToFaceDistanceCoversTheTruth) {
  int covered = 0;
  constexpr int kTrials = 40;
  for (int i = 0; i < kTrials; ++i) {
    const Mesh mesh = part(static_cast<std::uint64_t>(1000 + 10 * i), 0.02);
    const auto found = measured(
        mesh, PickedQuantity::Distance, {at(mesh, {7, 9, 8}, true), at(mesh, {30, 20, 0}, true)});
    covered += std::abs(found.value - 8.0) <= found.u95 ? 1 : 0;
  }
  EXPECT_GE(covered, 35);  // fewer of 40 at 95 %: once in 100
}

TEST(MeasurePicked, AHoleHasItsDiameterWhereverItIsPicked) {
  const Mesh mesh = part();
  const auto place = at(mesh, {66, 0, 13}, true);
  const auto found = measured(mesh, PickedQuantity::Diameter, {place});
  EXPECT_NEAR(found.value, 12.0, 0.01);
  EXPECT_LT(std::abs(found.value - 12.0), 2.0 * found.u95 + 1e-3);
  EXPECT_EQ(found.elements[0].feature.fit.shape.kind, ShapeKind::Cylinder);
  EXPECT_NEAR((found.to_mm - found.from_mm).norm(), 12.0, 0.01);
  EXPECT_LT((found.to_mm - place.point_mm).norm(), 0.1);  // the line ends where it was picked
  EXPECT_NEAR(found.from_mm.x(), 54.0, 0.1);
}

TEST(MeasurePicked, AnAxisIsFarFromAPoint) {
  const Mesh mesh = part();
  const auto found = measured(
      mesh, PickedQuantity::Distance, {at(mesh, {40, 0, 8}, false), at(mesh, {66, 0, 13}, true)});
  EXPECT_NEAR(found.value, 20.0, 0.3);  // the point is that of the corner's triangle
  EXPECT_NEAR((found.to_mm - Vector3d(60, 0, found.to_mm.z())).norm(), 0.0, 0.02);
  EXPECT_NEAR((found.to_mm - found.from_mm).norm(), found.value, 1e-6);
}

TEST(MeasurePicked, FacesAndPointsHaveTheirAngle) {
  const Mesh mesh = part();
  const auto faces = measured(
      mesh, PickedQuantity::Angle, {at(mesh, {20, 15, 8}, true), at(mesh, {20, 60, 5.77}, true)});
  EXPECT_NEAR(faces.value, 30.0, 0.02);
  EXPECT_LT(std::abs(faces.value - 30.0), 2.0 * faces.u95 + 1e-3);
  const auto corner = measured(
      mesh,
      PickedQuantity::Angle,
      {at(mesh, {35, 5, 8}, false), at(mesh, {5, 5, 8}, false), at(mesh, {5, 25, 8}, false)});
  EXPECT_NEAR(corner.value, 90.0, 2.0);
  EXPECT_GT(corner.u95, 0.0);
}

TEST(MeasurePicked, AWallIsAsThickAsItIs) {
  const Mesh mesh = part();
  const auto found = measured(mesh, PickedQuantity::Thickness, {at(mesh, {20, 15, 8}, false)});
  EXPECT_NEAR(found.value, 8.0, 0.05);
  EXPECT_NEAR(found.u95, 1.96 * std::sqrt(2.0) * kNoise_mm, 0.002);
  EXPECT_NEAR(found.to_mm.z(), 0.0, 0.05);
}

TEST(MeasurePicked, RefusesWhatCannotBeMeasured) {
  const Mesh mesh = part();
  const auto plane = at(mesh, {20, 15, 8}, true);
  const auto point = at(mesh, {20, 15, 8}, false);
  const auto refusal = [&](PickedQuantity quantity, const std::vector<PickedPlace>& places) {
    return testing::error_of([&] { static_cast<void>(measured(mesh, quantity, places)); });
  };
  EXPECT_NE(refusal(PickedQuantity::Distance, {plane}).find("two points or faces"),
            std::string::npos);
  EXPECT_NE(refusal(PickedQuantity::Diameter, {plane}).find("a plane has no diameter"),
            std::string::npos);
  EXPECT_NE(refusal(PickedQuantity::Diameter, {point}).find("a point has no diameter"),
            std::string::npos);
  EXPECT_NE(refusal(PickedQuantity::Angle, {plane, point}).find("between two faces"),
            std::string::npos);
  EXPECT_NE(refusal(PickedQuantity::Thickness, {plane}).find("one point"), std::string::npos);
  EXPECT_NE(refusal(PickedQuantity::Thickness, {at(mesh, {20, 60, 5.77}, false)}).find("no wall"),
            std::string::npos);
  EXPECT_NE(refusal(PickedQuantity::Volume, {}).find("has a hole"), std::string::npos);
  PickedPlace nowhere = point;
  nowhere.triangle = 4'000'000;
  EXPECT_NE(refusal(PickedQuantity::Thickness, {nowhere}).find("no such place"), std::string::npos);
}

}  // namespace
}  // namespace frangia
