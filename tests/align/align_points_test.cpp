// A part is put on its reference by pairs of points.
#include "frangia/align/align_points.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"

#include "support/error_of.h"

namespace frangia {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::error_of;

const std::vector<Vector3d> kPlaces{{0, 0, 0}, {60, 5, 0}, {10, 40, 8}, {30, 20, 35}};

Isometry3d any_pose() {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(2.1, Vector3d(1, -2, 0.5).normalized()).matrix();
  pose.translation() = Vector3d(120, -40, 7);
  return pose;
}

std::vector<PointPair> pairs_of(std::size_t count,
                                const Isometry3d& pose,
                                double sigma_mm,
                                std::uint64_t seed) {
  std::vector<PointPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    PointPair pair{pose.inverse() * kPlaces[i], kPlaces[i]};
    for (Eigen::Index side = 0; side < 3; ++side) {
      pair.scan_mm[side] +=
          sigma_mm * normal_from(hash(hash(seed, i), static_cast<std::uint64_t>(side)));
    }
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(AlignToPoints, RestoresThePoseByThreePairs) {
  const PointAlignment found = align_to_points(pairs_of(3, any_pose(), 0.0, 1));
  EXPECT_TRUE(found.reference_from_mesh.isApprox(any_pose(), 1e-10));
  ASSERT_EQ(found.distances_mm.size(), 3U);
  for (const double distance : found.distances_mm)
    EXPECT_NEAR(distance, 0.0, 1e-10);
  EXPECT_GT(found.reference_from_mesh.linear().determinant(), 0.0);
}

/// Errors of a point of the part that the pairs leave, over 400 draws.
TEST(AlignToPoints, StatesHowFarTheErrorsOfThePointsMoveThePart) {
  constexpr int kDraws = 400;
  const Vector3d place(50, 45, 10);
  for (const std::size_t count : {3U, 4U}) {
    int covered = 0;
    for (std::uint64_t seed = 0; seed < kDraws; ++seed) {
      const PointAlignment found = align_to_points(pairs_of(count, any_pose(), 0.5, seed));
      const Vector3d error = found.reference_from_mesh * (any_pose().inverse() * place) - place;
      const double u = found.uncertainty.along(place, Vector3d::UnitZ());
      covered += std::abs(error.z()) < 1.96 * u ? 1 : 0;
    }
    EXPECT_GE(covered, static_cast<int>(0.92 * kDraws)) << count;
    EXPECT_LE(covered, static_cast<int>(0.98 * kDraws)) << count;
  }
}

TEST(AlignToPoints, RefusesPairsThatDetermineNoPose) {
  const auto refused = [](std::vector<PointPair> pairs) {
    return error_of([&] { static_cast<void>(align_to_points(pairs)); });
  };
  EXPECT_NE(refused(pairs_of(2, any_pose(), 0.0, 1)).find("there are 2"), std::string::npos);
  auto line = pairs_of(3, any_pose(), 0.0, 1);
  line[2].reference_mm = 0.5 * (line[0].reference_mm + line[1].reference_mm);
  line[2].scan_mm = 0.5 * (line[0].scan_mm + line[1].scan_mm);
  EXPECT_NE(refused(line).find("lie on one line"), std::string::npos) << refused(line);
  auto inches = pairs_of(4, any_pose(), 0.0, 1);
  for (PointPair& pair : inches)
    pair.reference_mm /= 25.4;
  EXPECT_NE(refused(inches).find("0.03937 times"), std::string::npos) << refused(inches);
  auto other = pairs_of(4, any_pose(), 0.0, 1);
  other[3].reference_mm.z() -= 60.0;
  EXPECT_NE(refused(other).find("pair 4 does not match"), std::string::npos) << refused(other);
  other[0].scan_mm.x() = std::nan("");
  EXPECT_NE(refused(other).find("finite"), std::string::npos);
}

}  // namespace
}  // namespace frangia
