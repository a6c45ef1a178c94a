#include "frangia/align/align_best_fit.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/simulate/parts.h"

#include "support/error_of.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Any rotation, and a translation of 500 mm.
Isometry3d far_pose(std::uint64_t seed) {
  Eigen::Vector4d turn;
  Vector3d way;
  for (int i = 0; i < 4; ++i)
    turn[i] = normal_from(hash(seed, static_cast<std::uint64_t>(i)));
  for (int i = 0; i < 3; ++i)
    way[i] = normal_from(hash(seed, static_cast<std::uint64_t>(10 + i)));
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(turn.normalized()).toRotationMatrix();
  pose.translation() = 500.0 * way.normalized();
  return pose;
}

/// Few samples and rotations keep the tests short.
BestFitOptions quick() {
  BestFitOptions options;
  options.rotations = 400;
  options.fine_samples = 12000;
  return options;
}

/// Distance and angle between a found pose and the one that undoes `moved`.
void expect_undone(const Isometry3d& found, const Isometry3d& moved) {
  const Isometry3d left = found * moved;
  EXPECT_LT((left * Vector3d(0, 0, 40) - Vector3d(0, 0, 40)).norm(), 0.005);
  EXPECT_LT(deg_from_rad(Eigen::AngleAxisd(left.linear()).angle()), 0.01);
}

/// A closed solid of revolution about z, through points of radius and height.
Mesh turned(const std::vector<Eigen::Vector2d>& outline) {
  constexpr int kAround = 180;
  Mesh mesh;
  for (const Eigen::Vector2d& ring : outline) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = kTwoPi * i / kAround;
      mesh.vertices_mm.emplace_back(
          Vector3d(ring.x() * std::cos(angle), ring.x() * std::sin(angle), ring.y()).cast<float>());
    }
  }
  for (std::size_t ring = 0; ring + 1 < outline.size(); ++ring) {
    for (int i = 0; i < kAround; ++i) {
      const auto a = static_cast<std::uint32_t>(ring * kAround) + static_cast<std::uint32_t>(i);
      const auto b = static_cast<std::uint32_t>(ring * kAround) +
                     static_cast<std::uint32_t>((i + 1) % kAround);
      mesh.triangles.push_back({a, b, b + kAround});
      mesh.triangles.push_back({a, b + kAround, a + kAround});
    }
  }
  return mesh;
}

TEST(AlignBestFit, FindsTheBracketFromFarAway) {
  const RayScene reference(make_bracket());
  for (const std::uint64_t seed : {1U, 2U}) {
    const Isometry3d moved = far_pose(seed);
    const Alignment found =
        align_best_fit(transform_mesh(make_bracket(), moved), reference, quick());
    expect_undone(found.pose.reference_from_mesh, moved);
    EXPECT_GT(found.pose.overlap, 0.999);
    EXPECT_LT(found.pose.rms_mm, 0.001);
    EXPECT_TRUE(found.free_directions.empty());
    EXPECT_EQ(found.alternatives.size(), 1U);
  }
}

TEST(AlignBestFit, FindsAPartOfThePart) {
  Mesh part = make_bracket();
  std::erase_if(part.triangles, [&](const Mesh::Triangle& triangle) {
    return part.vertices_mm[triangle[0]].z() < 20.0F;
  });
  const Isometry3d moved = far_pose(3);
  const Alignment found =
      align_best_fit(transform_mesh(part, moved), RayScene(make_bracket()), quick());
  expect_undone(found.pose.reference_from_mesh, moved);
}

TEST(AlignBestFit, NamesTheRotationThatATurnedPartLeavesFree) {
  const Mesh part = turned({{0.01, 0}, {20, 0}, {20, 30}, {12, 30}, {12, 70}, {0.01, 70}});
  const Alignment found =
      align_best_fit(transform_mesh(part, far_pose(4)), RayScene(part), quick());
  ASSERT_EQ(found.free_directions.size(), 1U);
  EXPECT_NE(found.free_directions[0].find("rotation about"), std::string::npos);
  EXPECT_EQ(found.alternatives.size(), 1U);
  EXPECT_LT(found.pose.rms_mm, 0.02);
}

TEST(AlignBestFit, ListsThePosesThatFitAlikeAndTakesTheChosenOne) {
  const RayScene reference(make_plate());
  BestFitOptions options = quick();
  const Mesh mesh = transform_mesh(make_plate(), far_pose(5));
  const std::string sentence =
      testing::error_of([&] { static_cast<void>(align_best_fit(mesh, reference, options)); });
  EXPECT_NE(sentence.find("alike in 4 poses"), std::string::npos) << sentence;
  options.start = 2;
  const Alignment chosen = align_best_fit(mesh, reference, options);
  EXPECT_EQ(chosen.alternatives.size(), 4U);
  EXPECT_GT(chosen.pose.overlap, 0.999);
  options.start = 4;
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(align_best_fit(mesh, reference, options));
            }).find("`start` 5 does not exist"),
            std::string::npos);
}

TEST(AlignBestFit, NamesAMirroredReference) {
  // The bracket is symmetric; a block on one side makes it one-handed.
  Mesh part = make_bracket();
  append_mesh(part, testing::box({0, 25, 8}, {30, 45, 30}));
  const Mesh mirrored = mirror_mesh(part, {Vector3d(1, 1, 0.3).normalized(), 0.0});
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(align_best_fit(part, RayScene(mirrored), quick()));
            }).find("mirror"),
            std::string::npos);
}

TEST(AlignBestFit, RefusesAnotherPartAndAnotherUnit) {
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(align_best_fit(make_bracket(), RayScene(make_shaft()), quick()));
            }).find("another part"),
            std::string::npos);
  Mesh inches = make_bracket();
  for (auto& vertex : inches.vertices_mm)
    vertex /= 25.4F;
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(align_best_fit(make_bracket(), RayScene(inches), quick()));
            }).find("the reference may be in inches"),
            std::string::npos);
}

Mesh scaled(Mesh mesh, float factor) {
  for (auto& vertex : mesh.vertices_mm)
    vertex *= factor;
  return mesh;
}

/// The bracket above a height: a scan of a part of it.
Mesh upper_part(float above_mm) {
  Mesh part = make_bracket();
  std::erase_if(part.triangles, [&](const Mesh::Triangle& triangle) {
    return part.vertices_mm[triangle[0]].z() < above_mm;
  });
  return part;
}

std::string refusal_of(const Mesh& mesh, const Mesh& reference) {
  return testing::error_of(
      [&] { static_cast<void>(align_best_fit(mesh, RayScene(reference), quick())); });
}

TEST(AlignBestFit, NamesTheFactorByWhichAPartOfThePartFits) {
  const Mesh part = transform_mesh(upper_part(20.0F), far_pose(6));
  const std::string centimetres = refusal_of(part, scaled(make_bracket(), 0.1F));
  EXPECT_NE(centimetres.find("10 times as large"), std::string::npos) << centimetres;
  EXPECT_NE(centimetres.find("the reference may be in centimetres"), std::string::npos)
      << centimetres;
}

TEST(AlignBestFit, NamesTheFactorByWhichASmallMeshFits) {
  // A mesh in inches lies near a large face of the reference by the reference's tolerance.
  const std::string inches =
      refusal_of(transform_mesh(scaled(make_bracket(), 1.0F / 25.4F), far_pose(7)), make_bracket());
  EXPECT_NE(inches.find("0.0393701 times as large"), std::string::npos) << inches;
  EXPECT_NE(inches.find("the mesh may be in inches:"), std::string::npos) << inches;
}

TEST(RefuseUnitOfPose, ComparesTheOverlapsAndNotTheBoxes) {
  const RayScene reference(make_bracket());
  const Isometry3d here = Isometry3d::Identity();
  EXPECT_NO_THROW(refuse_unit_of_pose(make_bracket(), reference, here));
  EXPECT_NO_THROW(refuse_unit_of_pose(upper_part(40.0F), reference, here));
  // 25.4 times as small, but nowhere on the reference by any unit.
  EXPECT_NO_THROW(refuse_unit_of_pose(testing::sphere({900, 0, 0}, 2.0, 16), reference, here));
  EXPECT_NE(testing::error_of([&] {
              refuse_unit_of_pose(scaled(make_bracket(), 1000.0F), reference, here);
            }).find("1000 times as large"),
            std::string::npos);
  // A reference in mm that was read in metres.
  const RayScene metres(scaled(make_bracket(), 1000.0F));
  const std::string advice = testing::error_of(
      [&] { refuse_unit_of_pose(make_bracket(), metres, here, {.reference_unit_mm = 1000.0}); });
  EXPECT_NE(advice.find("0.001 times as large"), std::string::npos) << advice;
  EXPECT_NE(advice.find("a unit of 1000 mm, and mm fits: state that by `units`"), std::string::npos)
      << advice;
}

}  // namespace
}  // namespace frangia
