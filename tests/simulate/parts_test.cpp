#include "frangia/simulate/parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/geometry/ray_scene.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::open_edges;
using testing::volume_mm3;

class Parts : public ::testing::TestWithParam<std::string> {};

TEST_P(Parts, AreClosedOutwardAndStandOnTheGroundAboutTheAxis) {
  const Mesh mesh = make_part(GetParam());
  EXPECT_EQ(open_edges(mesh), 0U);
  EXPECT_GT(volume_mm3(mesh), 1000.0);
  Eigen::AlignedBox3f bounds;
  for (const auto& vertex : mesh.vertices_mm)
    bounds.extend(vertex);
  EXPECT_NEAR(bounds.min().z(), 0.0F, 1e-4F);
  EXPECT_LT(bounds.max().z(), 120.0F);
  EXPECT_LT(std::max(bounds.max().head<2>().norm(), bounds.min().head<2>().norm()), 65.0F);
  EXPECT_TRUE(RayScene(mesh).first_hit({200, 0, 30}, {-1, 0, 0}) ||
              RayScene(mesh).first_hit({200, 35, 30}, {-1, 0, 0}));
}

INSTANTIATE_TEST_SUITE_P(All, Parts, ::testing::ValuesIn(part_names()), [](const auto& instance) {
  std::string name = instance.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Plate, HasTheVolumeOfItsSides) {
  EXPECT_NEAR(volume_mm3(make_plate()), 80.0 * 60.0 * 6.0, 1e-3);
}

TEST(Groove, HasTheVolumeOfItsBlockWithoutTheGroove) {
  EXPECT_NEAR(volume_mm3(make_groove()), (35.0 * 64.0 - 25.0 * 25.0) * 50.0, 1e-2);
}

TEST(BallBar, HasTheVolumeOfItsSolids) {
  // A ball less the cap that the post replaces, a post up to there, the base.
  const double inner = std::sqrt(20.0 * 20.0 - 7.0 * 7.0);
  const double cap_height = 20.0 - inner;
  const double cap = kPi * cap_height * cap_height * (20.0 - cap_height / 3.0);
  const double ball = 4.0 / 3.0 * kPi * 8000.0 - cap;
  const double post = kPi * 49.0 * (60.0 - inner - 8.0);
  const double expected = 2.0 * (ball + post) + 40.0 * 120.0 * 8.0;
  EXPECT_NEAR(volume_mm3(make_ball_bar()), expected, 2e-4 * expected);
}

TEST(BallBar, HasItsBallsWhereTheyBelong) {
  for (const auto& vertex : make_ball_bar().vertices_mm) {
    if (vertex.z() < 41.3F) continue;
    const Eigen::Vector3d center(0.0, vertex.y() < 0.0F ? -35.0 : 35.0, 60.0);
    EXPECT_NEAR((vertex.cast<double>() - center).norm(), 20.0, 1e-5);
  }
}

TEST(Shaft, HasTheVolumeOfItsConesLessTheKeyway) {
  const std::vector<std::array<double, 2>> rings = {{17, 0},
                                                    {18, 1},
                                                    {18, 18},
                                                    {22, 18},
                                                    {22, 21},
                                                    {25, 21},
                                                    {26, 22},
                                                    {26, 37},
                                                    {25, 38},
                                                    {18, 38},
                                                    {18, 79},
                                                    {17, 80},
                                                    {13, 80},
                                                    {13, 83},
                                                    {14, 83},
                                                    {14, 99},
                                                    {13, 100}};
  double expected = 0.0;
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const double a = rings[i - 1][0];
    const double b = rings[i][0];
    expected += kPi / 3.0 * (rings[i][1] - rings[i - 1][1]) * (a * a + a * b + b * b);
  }
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double y = -3.0 + 6.0 * (i + 0.5) / kSteps;
    const double height = 18.0 + 2.0 * std::sqrt(9.0 - y * y);
    expected -= 6.0 / kSteps * height * (std::sqrt(18.0 * 18.0 - y * y) - 14.0);
  }
  EXPECT_NEAR(volume_mm3(make_shaft()), expected, 1e-4 * expected);
}

TEST(Bracket, HasTheVolumeOfItsPlatesLessTheBores) {
  const double plates = 50.0 * (60.0 * 8.0 + 8.0 * 54.0 + 38.0 * 8.0);
  const double rib = 6.0 * 0.5 * 30.0 * 30.0;
  const double bores = kPi * 8.0 * (2.0 * 25.0 + 2.0 * 36.0 + 49.0);
  EXPECT_NEAR(volume_mm3(make_bracket()), plates + rib - bores, 1.0);
}

TEST(Gear, HasTheVolumeOfItsInvoluteTeeth) {
  // ISO 53 basic rack of module 4, 20 degrees: the tooth thickness at the diameter d_y is
  // d_y (pi / 2z + inv(alpha) - inv(alpha_y)), and that of the base circle from there to the root.
  const auto involute = [](double angle) { return std::tan(angle) - angle; };
  const double alpha = 20.0 * kPi / 180.0;
  constexpr int kSteps = 20000;
  double tooth = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = 23.0 + 9.0 * (i + 0.5) / kSteps;
    const double alpha_y = std::acos(std::min(1.0, 28.0 * std::cos(alpha) / r));
    tooth += 9.0 / kSteps * 2.0 * r * (kPi / 28.0 + involute(alpha) - involute(alpha_y));
  }
  const double key = 2.0 * std::asin(2.5 / 7.0);
  const double bore = 0.5 * 49.0 * (kTwoPi - key) + 5.0 * 9.3 - 2.5 * 7.0 * std::cos(0.5 * key);
  const double expected =
      24.0 * (kPi * 23.0 * 23.0 + 14.0 * tooth) + 16.0 * kPi * 225.0 - 40.0 * bore;
  EXPECT_NEAR(volume_mm3(make_gear()), expected, 2e-4 * expected);
}

TEST(Bust, HasANoseInFrontAndEarsOnBothSides) {
  const RayScene bust(make_bust());
  const auto depth = [&](double y, double z) {
    const auto hit = bust.first_hit({100, y, z}, {-1, 0, 0});
    return hit ? 100.0 - hit->distance : -100.0;
  };
  EXPECT_GT(depth(0, 77), depth(5, 77) + 4.0);  // nose and cheek
  EXPECT_GT(depth(0, 90), depth(6, 84));        // brow and eye
  EXPECT_GT(depth(0, 66), depth(0, 60) + 5.0);  // chin and throat: an undercut
  for (const double side : {-1.0, 1.0}) {
    const auto ear = bust.first_hit({-2, 60 * side, 82}, {0, -side, 0});
    const auto cheek = bust.first_hit({6, 60 * side, 80}, {0, -side, 0});
    ASSERT_TRUE(ear && cheek);
    EXPECT_LT(ear->distance, cheek->distance - 2.0);
  }
}

TEST(MakePart, NamesWhatThereIs) {
  try {
    static_cast<void>(make_part("teapot"));
    FAIL() << "a teapot was made";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("bust"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("teapot"), std::string::npos);
  }
}

}  // namespace
}  // namespace frangia
