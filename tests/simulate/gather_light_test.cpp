#include "frangia/simulate/internal/gather_light.h"

#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/internal/render_view.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

constexpr SimulatedView kStraight{0, 0.0};
constexpr double kFar_mm = 5000.0;

/// A camera and a projector at the same far place, which look along z: rays are almost parallel.
Rig far_rig() {
  Rig rig;
  rig.reference().model = {.width_px = 101,
                           .height_px = 101,
                           .focal_px = {5000.0, 5000.0},
                           .principal_point_px = {50.0, 50.0}};
  rig.projector.model = PinholeModel{.width_px = 1001,
                                     .height_px = 1001,
                                     .focal_px = {10000.0, 10000.0},
                                     .principal_point_px = {500.0, 500.0}};
  rig.turntable = Turntable{{0.0, 0.0, kFar_mm}, {0.0, -1.0, 0.0}};
  return rig;
}

/// A mesh of the rig frame on the turntable.
Mesh on_turntable(const Mesh& in_rig, const Rig& rig) {
  return transform_mesh(in_rig, rig.rig_from_object(0.0).inverse());
}

/// Two walls of this width that meet at a right angle in the plane x = 0, open towards the camera.
Mesh right_angle(double wall_mm) {
  const auto side = static_cast<float>(wall_mm / std::sqrt(2.0));
  const auto far = static_cast<float>(kFar_mm);
  const float half = 1000.0F;
  Mesh mesh;
  mesh.vertices_mm = {{0, -half, far},
                      {0, half, far},
                      {-side, -half, far - side},
                      {-side, half, far - side},
                      {side, -half, far - side},
                      {side, half, far - side}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 5}};
  return mesh;
}

SimulateOptions exact_options() {
  SimulateOptions options;
  options.noise = false;
  options.bits = 16;
  return options;
}

/// Sum of the fringe over the cells, over that of full light, for a mean amplitude of 1.
std::complex<double> fringe_of(const std::vector<GatheredLight>& cells, double period_px) {
  std::complex<double> sum = 0.0;
  const auto mean_over = [&](float extent) {
    const double half = kPi * static_cast<double>(extent) / period_px;
    return std::abs(half) < 1e-6 ? 1.0 : std::sin(half) / half;
  };
  for (const GatheredLight& cell : cells) {
    sum += static_cast<double>(cell.diffuse) * mean_over(cell.side[0].x()) *
           mean_over(cell.side[1].x()) *
           std::polar(1.0, kTwoPi * static_cast<double>(cell.at.x()) / period_px);
  }
  return sum;
}

TEST(GatherLight, HasTheFormFactorOfTwoPerpendicularWalls) {
  constexpr double kWall_mm = 40.0;
  const Rig rig = far_rig();
  SimulateOptions options = exact_options();
  options.bounces = 1;
  options.albedo = 0.8;
  const auto scene = make_simulated_scene(
      on_turntable(right_angle(kWall_mm), rig), rig, std::span(&kStraight, 1), options);
  const Eigen::Isometry3d pose = rig.rig_from_object(0.0);
  for (const double x_mm : {3.0, 8.0, 20.0}) {
    const Eigen::Vector2d ray(x_mm / (kFar_mm - x_mm), 0.0);
    const double direct = static_cast<double>(sample_light(scene, pose, ray).diffuse);
    ASSERT_GT(direct, 0.5);
    const double period_px = 24.0;  // 12 mm across
    double all = 0.0;
    std::complex<double> fringe = 0.0;
    constexpr int kTurns = 60;
    for (int i = 0; i < kTurns; ++i) {
      const auto cells = gather_light(scene, pose, ray, (i + 0.5) / kTurns);
      all += total_light(cells) / kTurns;
      fringe += fringe_of(cells, period_px) / static_cast<double>(kTurns);
    }
    // An element of one wall, s from the corner, sees the strip dt of the other one, t from the
    // corner, with the form factor s t / (s^2 + t^2)^(3/2) / 2 dt.
    const double s = x_mm * std::sqrt(2.0);
    const double factor = 0.5 * (1.0 - s / std::hypot(s, kWall_mm));
    EXPECT_NEAR(all / direct / 0.8, factor, 0.02 * factor) << x_mm;
    std::complex<double> expected = 0.0;
    constexpr int kStrips = 20000;
    for (int i = 0; i < kStrips; ++i) {
      const double t = kWall_mm * (i + 0.5) / kStrips;
      const double z_mm = kFar_mm - t / std::sqrt(2.0);
      const double column = 500.0 - 10000.0 * t / std::sqrt(2.0) / z_mm;
      expected += 0.5 * s * t / std::pow(s * s + t * t, 1.5) * kWall_mm / kStrips *
                  std::polar(1.0, kTwoPi * column / period_px);
    }
    EXPECT_LT(std::abs(fringe / direct / 0.8 - expected), 0.04 * factor) << x_mm;
    EXPECT_GT(std::abs(expected), 0.009) << x_mm;
  }
}

TEST(GatherLight, ReturnsTheAlbedoInsideAUniformlyLitSphere) {
  Rig rig = far_rig();
  rig.projector.model = AngularModel{-kPi, kPi};  // light in all directions
  rig.projector.position_mm = {0.0, 0.0, kFar_mm};
  Mesh sphere = testing::sphere({0.0, 0.0, kFar_mm}, 50.0, 60);
  for (auto& triangle : sphere.triangles)
    std::swap(triangle[1], triangle[2]);
  SimulateOptions options = exact_options();
  options.bounces = 1;
  options.albedo = 0.6;
  rig.reference().model.focal_px = {50.0, 50.0};
  const Mesh part = on_turntable(sphere, rig);
  const auto scene = make_simulated_scene(part, rig, std::span(&kStraight, 1), options);
  // A camera inside the sphere.
  Eigen::Isometry3d pose = rig.rig_from_object(0.0);
  pose.translation() -= Eigen::Vector3d(0.0, 0.0, kFar_mm);
  SimulatedScene inside{.surface = RayScene(part),
                        .normals = scene.normals,
                        .rig = rig,
                        .known_rig = rig,
                        .working_distance_mm = 50.0,
                        .options = options};
  inside.rig.projector.position_mm.setZero();
  for (const double x : {-0.7, 0.0, 0.5}) {
    const double direct =
        static_cast<double>(sample_light(inside, pose, Eigen::Vector2d(x, 0.2)).diffuse);
    EXPECT_NEAR(direct, 1.0, 0.01);
    EXPECT_NEAR(total_light(gather_light(inside, pose, Eigen::Vector2d(x, 0.2), 0.3)), 0.6, 0.01);
  }
}

TEST(GatherLight, ScattersWithTheTransferFunctionOfTheProfile) {
  const Rig rig = far_rig();
  SimulateOptions options = exact_options();
  options.subsurface_mm = 1.5;
  Mesh plane;
  const auto far = static_cast<float>(kFar_mm);
  plane.vertices_mm = {{-200, -200, far}, {200, -200, far}, {200, 200, far}, {-200, 200, far}};
  plane.triangles = {{0, 2, 1}, {0, 3, 2}};
  const auto scene =
      make_simulated_scene(on_turntable(plane, rig), rig, std::span(&kStraight, 1), options);
  const Eigen::Isometry3d pose = rig.rig_from_object(0.0);
  const Eigen::Vector2d ray(1.0 / kFar_mm, 0.0);
  for (const double period_mm : {2.0, 5.0, 12.0, 40.0}) {
    const double period_px = 2.0 * period_mm;
    double all = 0.0;
    std::complex<double> fringe = 0.0;
    constexpr int kTurns = 40;
    for (int i = 0; i < kTurns; ++i) {
      const auto cells = gather_light(scene, pose, ray, (i + 0.5) / kTurns);
      all += total_light(cells) / kTurns;
      fringe += fringe_of(cells, period_px) / static_cast<double>(kTurns);
    }
    // The Hankel transform of (exp(-r/d) + exp(-r/3d)) / (8 pi d r).
    const double k = kTwoPi / period_mm * options.subsurface_mm / 2.5;
    const double expected = 0.25 / std::hypot(1.0, k) + 0.75 / std::hypot(1.0, 3.0 * k);
    EXPECT_NEAR(all, 1.0, 0.01);
    EXPECT_NEAR(std::abs(fringe), expected, 0.03) << period_mm;
    EXPECT_NEAR(wrap_rad(std::arg(fringe) - kTwoPi * (500.0 + 2.0) / period_px), 0.0, 0.05)
        << period_mm;
  }
}

TEST(GatherLight, AddsNoMoreLightThanTheAlbedoReflects) {
  Rig rig = rig_preset("digital");
  SimulateOptions options = exact_options();
  options.bounces = 1;
  options.albedo = 0.5;
  const SimulatedView view{0, 0.4};
  const auto scene = make_simulated_scene(make_bracket(), rig, std::span(&view, 1), options);
  const Eigen::Isometry3d pose = true_pose(scene, view);
  double brightest = 0.0;
  double most = 0.0;
  for (int y = 0; y < scene.rays.height(); y += 24) {
    for (int x = 0; x < scene.rays.width(); x += 24) {
      const Eigen::Vector2d ray = scene.rays(x, y).cast<double>();
      brightest = std::max(brightest, static_cast<double>(sample_light(scene, pose, ray).diffuse));
      most = std::max(most, total_light(gather_light(scene, pose, ray, 0.5)));
    }
  }
  EXPECT_GT(most, 0.05 * brightest);
  EXPECT_LT(most, 0.5 * brightest);
}

TEST(GatherLight, GivesTheSameFramesForAnyNumberOfThreads) {
  Rig rig = rig_preset("angular");
  rig.reference().model = {.width_px = 96,
                           .height_px = 96,
                           .focal_px = {190.0, 190.0},
                           .principal_point_px = {47.5, 47.5}};
  SimulateOptions options;
  options.bounces = 1;
  options.subsurface_mm = 0.5;
  const auto patterns = default_patterns(rig);  // fringes and the laser sheet
  const auto scene = make_simulated_scene(make_groove(), rig, std::span(&kStraight, 1), options);
  const auto many = render_view(scene, patterns, kStraight);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto single = render_view(scene, patterns, kStraight);
  for (std::size_t k = 0; k < many.size(); ++k) {
    for (std::size_t i = 0; i < many[k].frames.size(); ++i) {
      const auto& a = std::get<Image<std::uint8_t>>(many[k].frames[i]);
      const auto& b = std::get<Image<std::uint8_t>>(single[k].frames[i]);
      EXPECT_TRUE(std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin()));
    }
  }
}

TEST(GatherLight, RejectsValuesOutOfRange) {
  const Rig rig = far_rig();
  SimulateOptions options = exact_options();
  options.bounces = 2;
  EXPECT_THROW(static_cast<void>(
                   make_simulated_scene(make_groove(), rig, std::span(&kStraight, 1), options)),
               Error);
  options.bounces = 1;
  options.albedo = 1.2;
  EXPECT_THROW(static_cast<void>(
                   make_simulated_scene(make_groove(), rig, std::span(&kStraight, 1), options)),
               Error);
}

}  // namespace
}  // namespace frangia
