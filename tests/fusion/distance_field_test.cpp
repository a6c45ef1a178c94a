#include "frangia/fusion/internal/distance_field.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/fusion/internal/cell_loops.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

constexpr double kVoxel = 0.8;

TruncationBand band_of(double voxel_mm) {
  TruncationBand band;
  band.voxel_mm = voxel_mm;
  band.front_mm = 3.0 * voxel_mm;
  band.back_mm = 2.0 * voxel_mm;
  band.falloff_mm = 0.5 * voxel_mm;
  band.allocation_mm = 0.75 * voxel_mm;
  band.deepest_mm = 20.0 * voxel_mm;
  band.extrapolated_weight = 1e-6;
  band.deep_weight = 1e-9;
  return band;
}

DistanceField field_of(const testing::Shape& shape,
                       const std::vector<Eigen::Isometry3d>& poses,
                       const TruncationBand& band) {
  const CameraRays camera(testing::small_camera_model());
  DistanceField field;
  field.voxel_mm = band.voxel_mm;
  for (const auto& pose : poses) {
    const View view = testing::snapshot(shape, camera.model, pose, {.noise_mm = 0.0});
    integrate_view(field, local_planes(view, camera), camera, band);
  }
  return field;
}

/// Calls `check(point_mm, voxel)` for each voxel of the field.
template <typename Check>
void for_each_voxel(const DistanceField& field, const Check& check) {
  for (std::size_t block = 0; block < field.block_coords.size(); ++block) {
    for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
      const Eigen::Vector3i voxel =
          field.block_coords[block] * kBlockEdge + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
      check(Eigen::Vector3d(field.voxel_mm * voxel.cast<double>()),
            field.blocks[block][static_cast<std::size_t>(i)]);
    }
  }
}

TEST(DistanceField, HoldsTheDistanceFromASphereWithinTheBand) {
  const testing::Shape sphere = testing::sphere(30.0);
  const TruncationBand band = band_of(kVoxel);
  const DistanceField field = field_of(sphere, testing::all_around(8, 650.0), band);
  std::size_t measured = 0;
  for_each_voxel(field, [&](const Eigen::Vector3d& point, const DistanceField::Voxel& voxel) {
    const double truth = sphere(point);
    if (!(voxel.weight > 1.0F) || std::abs(truth) > kVoxel) return;
    ++measured;
    EXPECT_NEAR(static_cast<double>(voxel.weighted_mm / voxel.weight), truth, 0.06 * kVoxel);
  });
  // A shell of two voxels' width around the sphere.
  const double shell = 4.0 * kPi * 30.0 * 30.0 * 2.0 * kVoxel / std::pow(kVoxel, 3);
  EXPECT_GT(static_cast<double>(measured), 0.98 * shell);
  EXPECT_LT(static_cast<double>(measured), 1.02 * shell);
}

TEST(DistanceField, HasNoWeightFartherInFrontThanTheBand) {
  const TruncationBand band = band_of(kVoxel);
  const DistanceField field =
      field_of(testing::floor_at(0.0), {testing::look_from(0.3, 0.9, 650.0)}, band);
  std::size_t beyond = 0;
  for_each_voxel(field, [&](const Eigen::Vector3d& point, const DistanceField::Voxel& voxel) {
    if (point.z() < 1.01 * band.front_mm) return;
    ++beyond;
    EXPECT_EQ(voxel.weight, 0.0F) << point.transpose();
  });
  EXPECT_GT(beyond, 1000U);  // in blocks that the surface runs through
}

TEST(DistanceField, GivesAQuarterOfTheWeightAtTheFalloffDepth) {
  const TruncationBand band = band_of(kVoxel);
  const Eigen::Isometry3d above = testing::look_from(0.0, 1.57, 600.0);
  const DistanceField field = field_of(testing::floor_at(0.0), {above}, band);
  // On a column of voxels through the floor, 0.4 mm is the falloff depth.
  double in_front = 0.0;
  double below = 0.0;
  for_each_voxel(field, [&](const Eigen::Vector3d& point, const DistanceField::Voxel& voxel) {
    if (point.head<2>().norm() > 0.1) return;
    if (std::abs(point.z() - kVoxel) < 1e-6) in_front = static_cast<double>(voxel.weight);
    if (std::abs(point.z() + kVoxel) < 1e-6) below = static_cast<double>(voxel.weight);
  });
  ASSERT_GT(in_front, 0.0);
  // Twice the falloff depth: 1 / (1 + 2^2)^2.
  EXPECT_NEAR(below / in_front, 1.0 / 25.0, 0.002);
}

TEST(DistanceField, ScalesWithTheScene) {
  // A power of two, so that every number of the scaled scene is exact.
  constexpr double kScale = 8.0;
  const CameraRays camera(testing::small_camera_model());
  const auto integrate = [&](double scale) {
    TruncationBand band = band_of(scale * kVoxel);
    band.extrapolated_weight /= scale * scale;
    band.deep_weight /= scale * scale;
    View view =
        testing::snapshot(testing::sphere(30.0), camera.model, testing::look_from(0.3, 0.4, 650.0));
    for (float& depth : view.range.depth_mm.pixels())
      depth *= static_cast<float>(scale);
    for (float& sigma : view.range.sigma_mm.pixels())
      sigma *= static_cast<float>(scale);
    view.rig_from_object.translation() *= scale;
    DistanceField field;
    field.voxel_mm = band.voxel_mm;
    integrate_view(field, local_planes(view, camera), camera, band);
    return field;
  };
  const DistanceField one = integrate(1.0);
  const DistanceField scaled = integrate(kScale);
  ASSERT_EQ(one.block_coords, scaled.block_coords);
  const auto factor = static_cast<float>(kScale);
  for (std::size_t block = 0; block < one.blocks.size(); ++block) {
    for (std::size_t i = 0; i < DistanceField::kVoxels; ++i) {
      ASSERT_EQ(one.blocks[block][i].weight, scaled.blocks[block][i].weight * factor * factor);
      ASSERT_EQ(one.blocks[block][i].weighted_mm, scaled.blocks[block][i].weighted_mm * factor);
    }
  }
}

}  // namespace
}  // namespace frangia
