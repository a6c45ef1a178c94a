#include "frangia/simulate/internal/simulated_scene.h"

#include <functional>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"

namespace frangia {
namespace {

constexpr SimulatedView kFacing{0, 0.0};

SimulatedScene plate_scene(const SimulateOptions& options = {}) {
  return make_simulated_scene(
      make_plate(), rig_preset("carducci"), std::span(&kFacing, 1), options);
}

TEST(SimulatedScene, HasItsAxisAsFarOffAsAskedAndTellsNothingOfIt) {
  SimulateOptions options;
  options.axis_offset_mm = 0.7;
  options.axis_tilt_rad = rad_from_deg(0.4);
  const SimulatedScene scene = plate_scene(options);
  const Turntable& known = *scene.known_rig.turntable;
  const Turntable& real = *scene.rig.turntable;
  EXPECT_EQ(known.point_mm, rig_preset("carducci").turntable->point_mm);
  EXPECT_NEAR((real.point_mm - known.point_mm).norm(), 0.7, 1e-12);
  EXPECT_NEAR(std::acos(real.axis.dot(known.axis)), rad_from_deg(0.4), 1e-9);
  // The true axis's point is the one nearest to the given one.
  EXPECT_NEAR((real.point_mm - known.point_mm).dot(real.axis), 0.0, 1e-12);
}

TEST(SimulatedScene, TurnsWithTheAngleErrorAskedFor) {
  SimulateOptions options;
  options.angle_error_rad = rad_from_deg(0.1);
  const SimulatedScene scene = plate_scene(options);
  double sum2 = 0.0;
  constexpr std::size_t kViews = 400;
  for (std::size_t i = 0; i < kViews; ++i) {
    const Eigen::Isometry3d exact = scene.known_rig.rig_from_object(0.3);
    const Eigen::Isometry3d real = true_pose(scene, {i, 0.3});
    const double error = Eigen::AngleAxisd(exact.linear().transpose() * real.linear()).angle();
    sum2 += error * error;
  }
  EXPECT_NEAR(std::sqrt(sum2 / kViews), rad_from_deg(0.1), rad_from_deg(0.01));
}

TEST(SimulatedScene, TellsTheNoiseOfItsCamera) {
  SimulateOptions options;
  options.bits = 10;
  const SimulatedScene scene = plate_scene(options);
  EXPECT_EQ(scene.known_rig.reference().white_level, 1023);
  EXPECT_NEAR(scene.known_rig.reference().noise->slope_counts, 1023.0 / 20000.0, 1e-12);
  options.noise = false;
  EXPECT_FALSE(plate_scene(options).known_rig.reference().noise);
}

TEST(SimulatedScene, StandsThePartOnATurntableTop) {
  SimulateOptions options;
  options.turntable_top_radius_mm = 80.0;
  const RayScene& surface = plate_scene(options).surface;
  const auto hit = surface.first_hit({60, 0, 50}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 50.0, 1e-9);
  EXPECT_FALSE(plate_scene().surface.first_hit({60, 0, 50}, {0, 0, -1}));
}

TEST(LightSample, FallsWithTheCosineAndTheSquareOfTheDistance) {
  const SimulatedScene scene = plate_scene();
  const Rig& rig = scene.rig;
  const Eigen::Isometry3d pose = true_pose(scene, kFacing);
  const Eigen::Vector3d point = pose * Eigen::Vector3d(3.0, 10.0, 40.0);
  const Eigen::Vector3d to_light = rig.projector.position_mm - point;
  const double cosine = to_light.normalized().dot(pose.linear() * Eigen::Vector3d::UnitX());
  const double distance = (rig.projector.position_mm - rig.turntable->point_mm).norm();
  const LightSample sample = sample_light(scene, pose, point.head<2>() / point.z());
  EXPECT_NEAR(sample.diffuse, cosine * distance * distance / to_light.squaredNorm(), 1e-5);
  EXPECT_EQ(sample.albedo, 1.0F);
  EXPECT_EQ(sample_light(scene, pose, {0.5, 0.5}).albedo, 0.0F);
}

TEST(LightSample, TextureDarkensByItsStrengthAtMost) {
  SimulateOptions options;
  options.texture = 0.6;
  const SimulatedScene scene = plate_scene(options);
  const Eigen::Isometry3d pose = true_pose(scene, kFacing);
  float low = 1.0F;
  float high = 0.0F;
  for (int y = -39; y < 39; ++y) {
    for (int z = 1; z < 59; ++z) {
      const Eigen::Vector3d point = pose * Eigen::Vector3d(3.0, y, z);
      const float albedo = sample_light(scene, pose, point.head<2>() / point.z()).albedo;
      low = std::min(low, albedo);
      high = std::max(high, albedo);
    }
  }
  EXPECT_GE(low, 0.4F);
  EXPECT_LT(low, 0.6F);
  EXPECT_GT(high, 0.8F);
}

TEST(MakeSimulatedScene, NamesTheOptionThatMakesNoSense) {
  const auto message = [](const std::function<void(SimulateOptions&)>& change) {
    SimulateOptions options;
    change(options);
    try {
      static_cast<void>(plate_scene(options));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message([](auto& o) { o.bits = 9; }).find("bits is 9"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.contrast = 1.5; }).find("contrast is 1.5"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.speckle = -1.0; }).find("speckle"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.display_gamma = 2.2; }).find("display gamma"),
            std::string::npos);
  EXPECT_NE(message([](auto& o) { o.samples_per_px = 0; }).find("samples"), std::string::npos);
  EXPECT_TRUE(message([](auto& o) { o.texture = 1.0; }).empty());
}

TEST(MakeSimulatedScene, RefusesARigWithoutATurntableAndAnEmptyPart) {
  Rig rig = rig_preset("carducci");
  EXPECT_THROW(static_cast<void>(make_simulated_scene(Mesh{}, rig, std::span(&kFacing, 1))), Error);
  rig.turntable.reset();
  EXPECT_THROW(static_cast<void>(make_simulated_scene(make_plate(), rig, std::span(&kFacing, 1))),
               Error);
}

}  // namespace
}  // namespace frangia
