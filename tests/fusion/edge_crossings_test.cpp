#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/fusion/internal/cell_loops.h"

namespace frangia {
namespace {

/// A field of some blocks on each side of the origin with a given distance at each point; NaN is a
/// voxel without weight.
DistanceField field_of(const std::function<double(const Eigen::Vector3d&)>& distance_mm,
                       double voxel_mm,
                       int blocks) {
  DistanceField field;
  field.voxel_mm = voxel_mm;
  for (int z = -blocks; z < blocks; ++z) {
    for (int y = -blocks; y < blocks; ++y) {
      for (int x = -blocks; x < blocks; ++x) {
        const Eigen::Vector3i coords(x, y, z);
        field.index.add(block_key(coords), static_cast<std::uint32_t>(field.block_coords.size()));
        field.block_coords.push_back(coords);
        field.blocks.append_uninitialized();
        auto& block = field.blocks[field.block_coords.size() - 1];
        for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
          const Eigen::Vector3i voxel = coords * 8 + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
          const double d = distance_mm(voxel_mm * voxel.cast<double>());
          block[static_cast<std::size_t>(i)] =
              std::isnan(d) ? DistanceField::Voxel{0.0F, 0.0F}
                            : DistanceField::Voxel{static_cast<float>(2.0 * d), 2.0F};
        }
      }
    }
  }
  return field;
}

constexpr double kSpacing = 0.5;
constexpr double kRadius = 6.3;

double sphere(const Eigen::Vector3d& p) {
  return p.norm() - kRadius;
}

TEST(EdgeCrossings, OfASphereLieOnItAndFaceOutwards) {
  const EdgeCrossings crossings = find_edge_crossings(field_of(sphere, kSpacing, 2));
  // Cauchy-Crofton: the grid lines of one axis cross the surface of a sphere 2 pi r^2 / h^2 times.
  const double expected = 3.0 * kTwoPi * kRadius * kRadius / (kSpacing * kSpacing);
  EXPECT_NEAR(static_cast<double>(crossings.points_mm.size()) / expected, 1.0, 0.02);
  ASSERT_EQ(crossings.outward.size(), crossings.points_mm.size());
  for (std::size_t i = 0; i < crossings.points_mm.size(); ++i) {
    const Eigen::Vector3d point = crossings.points_mm[i].cast<double>();
    EXPECT_NEAR(sphere(point), 0.0, kSpacing * kSpacing / (8.0 * kRadius) + 1e-5);
    const int outward = crossings.outward[i];
    const double along = point[std::abs(outward) - 1];
    EXPECT_GT(outward > 0 ? along : -along, 0.0);
  }
}

TEST(EdgeCrossings, OfAClosedSurfaceFulfilEulersFormula) {
  // Dual contouring of a sphere: a face for each crossing, a vertex for each loop, quads of four
  // edges that two quads share: V - E + F = V - 2 F + F = 2.
  const EdgeCrossings crossings = find_edge_crossings(field_of(sphere, kSpacing, 2));
  EXPECT_EQ(crossings.vertices, crossings.points_mm.size() + 2);
}

TEST(EdgeCrossings, AreFoundAgainThroughTheNeighborhood) {
  const EdgeCrossings crossings = find_edge_crossings(field_of(sphere, kSpacing, 2));
  std::size_t found = 0;
  for (std::size_t block = 0; block < crossings.blocks.size(); ++block) {
    const auto around = crossings.neighborhood(block);
    for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
      const Eigen::Vector3i voxel =
          crossings.block_coords[block] * 8 + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
      for (int axis = 0; axis < 3; ++axis) {
        const unsigned axes = crossings.blocks[block]->axes[static_cast<std::size_t>(i)];
        if ((axes >> axis & 1U) == 0) continue;
        Eigen::Vector3f low = crossings.points_mm[around.crossing(voxel, axis)] -
                              static_cast<float>(kSpacing) * voxel.cast<float>();
        EXPECT_GE(low[axis], -1e-5F);
        EXPECT_LE(low[axis], static_cast<float>(kSpacing) + 1e-5F);
        low[axis] = 0.0F;
        EXPECT_LT(low.norm(), 1e-5F);
        ++found;
      }
    }
  }
  EXPECT_EQ(found, crossings.points_mm.size());
}

TEST(EdgeCrossings, LeaveOutStepsThatADistanceCannotHave) {
  // Two parallel surfaces of different views: the distance jumps from +1.5 to -1.5 voxels.
  const auto jump = [](const Eigen::Vector3d& p) {
    return p.z() < 0.1 ? 1.5 * kSpacing : -1.5 * kSpacing;
  };
  EXPECT_TRUE(find_edge_crossings(field_of(jump, kSpacing, 1)).points_mm.empty());
  FieldParameters wide;
  wide.max_step_voxels = 3.5;
  EXPECT_FALSE(find_edge_crossings(field_of(jump, kSpacing, 1), wide).points_mm.empty());
}

TEST(EdgeCrossings, HaveNoCellWithACornerThatWasNotMeasured) {
  const auto half = [](const Eigen::Vector3d& p) { return p.x() > 0.1 ? kMissing : p.z() - 0.2; };
  const EdgeCrossings crossings =
      find_edge_crossings(field_of([&](const auto& p) { return half(p); }, kSpacing, 1));
  for (std::size_t block = 0; block < crossings.blocks.size(); ++block) {
    for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
      const int x = crossings.block_coords[block].x() * 8 + (i & 7);
      const auto inside = crossings.blocks[block]->inside[static_cast<std::size_t>(i)];
      if (x >= 0) {
        EXPECT_EQ(inside, 0);  // its upper corners have x = 0.5
      }
    }
  }
  // 16 x 8 voxels with x from -4 to 0 have an edge in z that crosses, and y runs from -4 to 3.5.
  EXPECT_EQ(crossings.points_mm.size(), 16U * 9U);
}

}  // namespace
}  // namespace frangia
