#include "frangia/features/find_features.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/simulate/parts.h"

#include "features/noisy_shapes.h"
#include "support/error_of.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::add_patch;
using testing::noisy_cylinder;

/// Five surfaces apart from each other, in mm times `scale`.
Mesh five_surfaces(double scale) {
  Mesh mesh;
  const double noise = 0.01 * scale;
  const auto add = [&](std::uint64_t seed, const auto& place) {
    add_patch(mesh, 70, 70, noise, seed, [&](double u, double v) {
      return Eigen::Vector3d(scale * place(u, v));
    });
  };
  add(1, [](double u, double v) {
    return Eigen::Vector3d(10 * std::cos(kTwoPi * u), 10 * std::sin(kTwoPi * u), 40 * v);
  });
  add(2, [](double u, double v) {
    const double polar = 0.3 + 2.2 * v;
    return Eigen::Vector3d(60 + 12 * std::sin(polar) * std::cos(kTwoPi * u),
                           12 * std::sin(polar) * std::sin(kTwoPi * u),
                           -12 * std::cos(polar));
  });
  add(3, [](double u, double v) {
    const double radius = 5 + 8 * v;
    return Eigen::Vector3d(
        -50 + radius * std::cos(kTwoPi * u), radius * std::sin(kTwoPi * u), 30 * v);
  });
  add(4, [](double u, double v) {
    const double radius = 20 + 6 * std::cos(kTwoPi * v);
    return Eigen::Vector3d(radius * std::cos(kTwoPi * u),
                           80 + radius * std::sin(kTwoPi * u),
                           6 * std::sin(kTwoPi * v));
  });
  add(5, [](double u, double v) { return Eigen::Vector3d(-30 + 60 * u, -60 + 40 * v, 5); });
  return mesh;
}

const Feature* find(const std::vector<Feature>& features, ShapeKind kind) {
  const auto at = std::find_if(features.begin(), features.end(), [&](const Feature& feature) {
    return feature.fit.shape.kind == kind;
  });
  return at == features.end() ? nullptr : &*at;
}

class FindFeaturesAtScale : public ::testing::TestWithParam<double> {};

TEST_P(FindFeaturesAtScale, FindsEachSurfaceOnceWithItsSize) {
  const double scale = GetParam();
  const std::vector<Feature> features = find_features(five_surfaces(scale));
  ASSERT_EQ(features.size(), 5U);
  const Feature* cylinder = find(features, ShapeKind::Cylinder);
  const Feature* sphere = find(features, ShapeKind::Sphere);
  const Feature* cone = find(features, ShapeKind::Cone);
  const Feature* torus = find(features, ShapeKind::Torus);
  const Feature* plane = find(features, ShapeKind::Plane);
  ASSERT_TRUE(cylinder && sphere && cone && torus && plane);
  EXPECT_NEAR(cylinder->fit.shape.radius_mm, 10 * scale, 0.001 * scale);
  EXPECT_NEAR(sphere->fit.shape.radius_mm, 12 * scale, 0.001 * scale);
  EXPECT_NEAR(torus->fit.shape.radius_mm, 20 * scale, 0.002 * scale);
  EXPECT_NEAR(torus->fit.shape.tube_radius_mm, 6 * scale, 0.002 * scale);
  EXPECT_NEAR(cone->fit.shape.half_angle_rad, std::atan(8.0 / 30.0), 0.0005);
  EXPECT_LT((sphere->fit.shape.center_mm - scale * Eigen::Vector3d(60, 0, 0)).norm(),
            0.002 * scale);
  EXPECT_NEAR(std::abs(plane->fit.shape.axis.z()), 1.0, 1e-6);
  EXPECT_NEAR(plane->fit.shape.center_mm.z(), 5 * scale, 0.001 * scale);
  EXPECT_NEAR(cylinder->fit.rms_mm, 0.01 * scale, 0.0005 * scale);
}

INSTANTIATE_TEST_SUITE_P(Scales, FindFeaturesAtScale, ::testing::Values(0.1, 1.0, 10.0));

TEST(FindFeatures, FindsTheCylindersOfATessellatedShaft) {
  const std::vector<Feature> features = find_features(make_shaft());
  std::map<int, int> found;  // by diameter in mm
  for (const Feature& feature : features) {
    if (feature.fit.shape.kind != ShapeKind::Cylinder) continue;
    const double diameter = 2.0 * feature.fit.shape.radius_mm;
    if (std::abs(diameter - std::round(diameter)) < 0.01)
      ++found[static_cast<int>(std::round(diameter))];
    EXPECT_FALSE(feature.hole && diameter > 10.0);
  }
  for (const int diameter : {28, 36, 44, 52})
    EXPECT_GE(found[diameter], 1) << diameter;
}

TEST(FindFeatures, NamesTheInsideOfACylinderAHole) {
  Mesh mesh = noisy_cylinder(8, 20, 0.005, 1);
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  const std::vector<Feature> features = find_features(mesh);
  ASSERT_EQ(features.size(), 1U);
  EXPECT_TRUE(features[0].hole);
  EXPECT_FALSE(find_features(noisy_cylinder(8, 20, 0.005, 1)).at(0).hole);
}

TEST(FindFeatures, FindsTheEdgesOfABox) {
  const std::vector<Feature> features = find_features(testing::box({0, 0, 0}, {30, 20, 10}));
  const auto count = [&](ShapeKind kind) {
    return std::count_if(features.begin(), features.end(), [&](const Feature& feature) {
      return feature.fit.shape.kind == kind;
    });
  };
  EXPECT_EQ(count(ShapeKind::Plane), 6);
  EXPECT_EQ(count(ShapeKind::Line), 12);
  EXPECT_EQ(features.size(), 18U);
}

/// A turned end: a cylinder of 18 mm, a chamfer of 1.4 mm at 45 degrees and the end face, whose
/// edges are rounded by 0.8 mm as a measurement does.
Mesh chamfered_end() {
  std::vector<Eigen::Vector2d> outline;  // radius and height
  constexpr double kStep = 0.28;
  constexpr double kRounding = 0.8;
  Eigen::Vector2d at(18.0, 0.0);
  double heading = kPi / 2.0;
  const auto go = [&](double length, double turn) {
    const int steps = std::max(1, static_cast<int>(std::lround(length / kStep)));
    for (int i = 0; i < steps; ++i) {
      heading += 0.5 * turn / steps;
      at += length / steps * Eigen::Vector2d(std::cos(heading), std::sin(heading));
      heading += 0.5 * turn / steps;
      outline.push_back(at);
    }
  };
  go(15.0, 0.0);
  go(kRounding * kPi / 4.0, kPi / 4.0);
  go(0.8, 0.0);
  go(kRounding * kPi / 4.0, kPi / 4.0);
  go(8.0, 0.0);
  Mesh mesh;
  add_patch(mesh, 400, static_cast<int>(outline.size()), 0.003, 7, [&](double u, double v) {
    const Eigen::Vector2d& point =
        outline[static_cast<std::size_t>(std::lround(v * static_cast<double>(outline.size() - 1)))];
    return Eigen::Vector3d(
        point.x() * std::cos(kTwoPi * u), point.x() * std::sin(kTwoPi * u), point.y());
  });
  return mesh;
}

TEST(FindFeatures, TakesANarrowChamferWithRoundedEdgesForACone) {
  const std::vector<Feature> features = find_features(chamfered_end());
  EXPECT_EQ(find(features, ShapeKind::Sphere), nullptr);
  const Feature* chamfer = find(features, ShapeKind::Cone);
  ASSERT_NE(chamfer, nullptr);
  EXPECT_NEAR(chamfer->fit.shape.half_angle_rad, kPi / 4.0, 0.02);
  EXPECT_NEAR(std::abs(chamfer->fit.shape.axis.z()), 1.0, 1e-4);
}

TEST(FindFeatures, PrefersAWantedKindWhereItFitsNearlyAllPoints) {
  const auto cone_of = [](double taper_mm) {
    Mesh mesh;
    testing::add_patch(mesh, 120, 40, 0.01, 7, [&](double u, double v) {
      const double angle = kTwoPi * u;
      const double radius = 14.0 + taper_mm * v;
      return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 20.0 * v);
    });
    return mesh;
  };
  FindFeaturesOptions wanting{.edges = false};
  wanting.wanted = [](const Shape& shape) { return shape.kind == ShapeKind::Cylinder; };
  const Mesh hardly = cone_of(0.02);
  const auto as_it_is = find_features(hardly, {.edges = false});
  ASSERT_EQ(as_it_is.size(), 1U);
  EXPECT_EQ(as_it_is.front().fit.shape.kind, ShapeKind::Cone);
  const auto wanted = find_features(hardly, wanting);
  ASSERT_EQ(wanted.size(), 1U);
  EXPECT_EQ(wanted.front().fit.shape.kind, ShapeKind::Cylinder);
  EXPECT_NEAR(wanted.front().fit.shape.radius_mm, 14.01, 0.001);
  const auto clearly = find_features(cone_of(2.0), wanting);
  ASSERT_EQ(clearly.size(), 1U);
  EXPECT_EQ(clearly.front().fit.shape.kind, ShapeKind::Cone);
}

TEST(FindFeatures, IgnoresSynthesizedTriangles) {
  Mesh mesh = noisy_cylinder(8, 20, 0.005, 1);
  mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Synthesized);
  EXPECT_NE(testing::error_of([&] { static_cast<void>(find_features(mesh)); }).find("no measured"),
            std::string::npos);
}

TEST(FindFeatures, PrefersThePlaneWhereACylinderFitsAsWell) {
  Mesh mesh;
  add_patch(mesh, 80, 80, 0.01, 7, [](double u, double v) {
    return Eigen::Vector3d(30 * u, 30 * v, 0.0);
  });
  const std::vector<Feature> features = find_features(mesh);
  ASSERT_EQ(features.size(), 1U);
  EXPECT_EQ(features[0].fit.shape.kind, ShapeKind::Plane);
}

}  // namespace
}  // namespace frangia
