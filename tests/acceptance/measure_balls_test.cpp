// Balls of known size, place and form, as meshes.
#include "frangia/acceptance/measure_balls.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/simulate/parts.h"

#include "support/error_of.h"

namespace frangia {
namespace {

const ReferenceArtifact kBar{.diameters_mm = {40.0, 30.0}, .spacing_mm = 80.0, .u95_mm = 0.001};

/// The bar along z, between -40 and 40, whose points are moved by a function of their position.
template <typename Change>
Mesh changed_bar(const Change& change) {
  Mesh mesh = make_dumbbell(kBar.diameters_mm, kBar.spacing_mm);
  mesh.normals.clear();
  for (Eigen::Vector3f& vertex : mesh.vertices_mm)
    vertex = change(vertex.cast<double>().eval()).template cast<float>();
  return mesh;
}

TEST(MeasureBalls, FindsSizesSpacingAndLengthOfABallBar) {
  // A scanner whose scale is wrong by 1e-3.
  const MeasuredArtifact measured = measure_balls(
      changed_bar([](const Eigen::Vector3d& p) { return Eigen::Vector3d(1.001 * p); }), kBar);
  ASSERT_EQ(measured.balls.size(), 2U);
  EXPECT_NEAR(measured.balls[0].diameter_mm, 40.04, 0.001);
  EXPECT_NEAR(measured.balls[1].diameter_mm, 30.03, 0.001);
  EXPECT_NEAR(measured.spacing_mm, 80.08, 0.001);
  EXPECT_NEAR(measured.length_mm, 80.08 + 20.02 + 15.015, 0.001);
  for (const MeasuredBall& ball : measured.balls) {
    EXPECT_LT(ball.form_all_mm, 0.002);  // chords
    // All but the stem, a quarter of the smaller ball's radius, and 6 degrees around it; the poles'
    // neighbourhood fills up to 6 degrees again.
    EXPECT_GT(ball.seen, 0.97);
  }
}

TEST(MeasureBalls, FormHoldsEveryPointButThoseThatTheStandardAllowsToDiscard) {
  // A dent of 0.1 mm on 1 % of the lower ball's points: counted in all, not in 95 %.
  const Eigen::Vector3d center(0.0, 0.0, -40.0);
  const auto dented = changed_bar([&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d from = p - center;
    const bool dent = p.z() < -20.0 && from.normalized().x() > 0.97;  // 1.5 % of the sphere
    return dent ? Eigen::Vector3d(p - 0.1 * from.normalized()) : p;
  });
  const MeasuredArtifact measured = measure_balls(dented, kBar);
  EXPECT_NEAR(measured.balls[0].form_all_mm, 0.1, 0.004);
  EXPECT_LT(measured.balls[0].form_95_mm, 0.01);
  EXPECT_LT(measured.balls[1].form_all_mm, 0.002);
}

TEST(MeasureBalls, AnOvalBallHasItsForm) {
  const auto oval = changed_bar(
      [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x() * 1.001, p.y(), p.z()); });
  const MeasuredArtifact measured = measure_balls(oval, kBar);
  EXPECT_NEAR(measured.balls[0].form_all_mm, 0.02, 0.002);  // 20 mm of radius by 1e-3
}

TEST(MeasureBalls, ALengthWhoseEndIsNotSeenIsNotMeasured) {
  Mesh mesh = make_dumbbell(kBar.diameters_mm, kBar.spacing_mm);
  std::erase_if(mesh.triangles, [&](const Mesh::Triangle& triangle) {
    return mesh.vertices_mm[triangle[0]].z() < -54.0F;
  });
  const MeasuredArtifact measured = measure_balls(mesh, kBar);
  EXPECT_TRUE(std::isnan(measured.length_mm));
  EXPECT_NEAR(measured.spacing_mm, 80.0, 0.001);
  EXPECT_LT(measured.balls[0].seen, 0.85);
}

TEST(MeasureBalls, SaysWhatItDoesNotFind) {
  const Mesh mesh = make_dumbbell(kBar.diameters_mm, kBar.spacing_mm);
  ReferenceArtifact other = kBar;
  other.diameters_mm = {20.0, 30.0};
  EXPECT_NE(testing::error_of([&] { (void)measure_balls(mesh, other); }).find("no ball of 20 mm"),
            std::string::npos);
  other = kBar;
  other.spacing_mm = 60.0;
  EXPECT_NE(testing::error_of([&] {
              (void)measure_balls(mesh, other);
            }).find("no two balls 60 mm from each other"),
            std::string::npos);
  const ReferenceArtifact single{.diameters_mm = {30.0}, .u95_mm = 0.001};
  EXPECT_EQ(measure_balls(mesh, single).balls.size(), 1U);
}

}  // namespace
}  // namespace frangia
