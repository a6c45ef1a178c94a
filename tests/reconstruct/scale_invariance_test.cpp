// No stage depends on absolute lengths: a scan whose rig is scaled gives the scaled mesh.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/geometry/ray_scene.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::small_scan;
using testing::TemporaryFolder;

/// The same frames, as if the rig and the part were `scale` times as large.
Scan scaled(Scan scan, double scale) {
  scan.rig.projector.position_mm *= scale;
  if (scan.rig.laser_sheet) scan.rig.laser_sheet->offset_mm *= scale;
  if (scan.rig.turntable) scan.rig.turntable->point_mm *= scale;
  for (auto& [setup, pose] : scan.part_poses)
    pose.translation() *= scale;
  return scan;
}

std::vector<Eigen::Vector3f> scaled(std::vector<Eigen::Vector3f> points, float scale) {
  for (Eigen::Vector3f& point : points)
    point *= scale;
  return points;
}

/// The median edge, which is about as long as a voxel.
double voxel_of(const Mesh& mesh) {
  std::vector<double> edges;
  for (const auto& [a, b, c] : mesh.triangles)
    edges.push_back(static_cast<double>((mesh.vertices_mm[a] - mesh.vertices_mm[b]).norm()));
  std::nth_element(
      edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2), edges.end());
  return edges[edges.size() / 2];
}

/// Root mean square distance from the vertices of one mesh to the surface of another.
double rms_distance(const Mesh& from, const Mesh& to) {
  const RayScene scene(to);
  double sum = 0.0;
  for (const Eigen::Vector3f& vertex : from.vertices_mm)
    sum += std::pow(scene.nearest(vertex.cast<double>())->distance_mm, 2);
  return std::sqrt(sum / static_cast<double>(from.vertices_mm.size()));
}

void expect_same_findings(const Reconstruction& found, const Reconstruction& wanted) {
  ASSERT_EQ(found.registration.has_value(), wanted.registration.has_value());
  if (!wanted.registration) return;
  EXPECT_EQ(found.registration->undetermined, wanted.registration->undetermined);
  EXPECT_EQ(found.registration->outliers, wanted.registration->outliers);
  EXPECT_EQ(found.registration->kept_rig, wanted.registration->kept_rig);
  EXPECT_EQ(std::isnan(found.turntable_top_height_mm), std::isnan(wanted.turntable_top_height_mm));
}

/// `any_scale`: also factors that change the rounding of every number.
void expect_scales(const Scan& scan, bool any_scale = false) {
  const Reconstruction wanted = reconstruct(scan);
  ASSERT_GT(wanted.mesh.triangles.size(), 1000U);
  for (const double scale : {0.125, 8.0}) {  // powers of two scale floating-point numbers exactly
    SCOPED_TRACE(scale);
    const Reconstruction found = reconstruct(scaled(scan, scale));
    EXPECT_EQ(found.points, wanted.points);
    EXPECT_EQ(found.mesh.triangles.size(), wanted.mesh.triangles.size());
    EXPECT_TRUE(found.mesh.triangles == wanted.mesh.triangles);
    const auto vertices_mm = scaled(found.mesh.vertices_mm, static_cast<float>(1.0 / scale));
    ASSERT_EQ(vertices_mm.size(), wanted.mesh.vertices_mm.size());
    std::size_t different = 0;
    float farthest_mm = 0.0F;
    for (std::size_t i = 0; i < vertices_mm.size(); ++i) {
      const float away_mm = (vertices_mm[i] - wanted.mesh.vertices_mm[i]).norm();
      different += away_mm > 0.0F ? 1U : 0U;
      farthest_mm = std::max(farthest_mm, away_mm);
    }
    EXPECT_EQ(different, 0U) << "by up to " << farthest_mm << " mm";
    std::vector<float> sigma_mm = found.mesh.sigma_mm;
    for (float& sigma : sigma_mm)
      sigma *= static_cast<float>(1.0 / scale);
    EXPECT_TRUE(sigma_mm == wanted.mesh.sigma_mm);
    expect_same_findings(found, wanted);
  }
  if (!any_scale) return;
  const double voxel_mm = voxel_of(wanted.mesh);
  for (const double scale : {0.1, 10.0}) {
    SCOPED_TRACE(scale);
    Reconstruction found = reconstruct(scaled(scan, scale));
    EXPECT_NEAR(static_cast<double>(found.points),
                static_cast<double>(wanted.points),
                0.001 * static_cast<double>(wanted.points));
    EXPECT_NEAR(static_cast<double>(found.mesh.triangles.size()),
                static_cast<double>(wanted.mesh.triangles.size()),
                0.001 * static_cast<double>(wanted.mesh.triangles.size()));
    found.mesh.vertices_mm = scaled(found.mesh.vertices_mm, static_cast<float>(1.0 / scale));
    EXPECT_LT(rms_distance(found.mesh, wanted.mesh), 0.01 * voxel_mm);
    EXPECT_LT(rms_distance(wanted.mesh, found.mesh), 0.01 * voxel_mm);
    expect_same_findings(found, wanted);
  }
}

TEST(ScaleInvariance, HoldsForAMisalignedTurntable) {
  const TemporaryFolder folder;
  SimulateOptions faults{.samples_per_px = 4};
  faults.axis_offset_mm = 0.5;
  faults.axis_tilt_rad = rad_from_deg(0.3);
  faults.angle_error_rad = rad_from_deg(0.15);
  expect_scales(small_scan(folder.path(), "bracket", "digital", 6, faults, 4), true);
}

TEST(ScaleInvariance, HoldsWithTheTurntableTopInView) {
  const TemporaryFolder folder;
  SimulateOptions faults{.samples_per_px = 4};
  faults.turntable_top_radius_mm = 70.0;
  expect_scales(small_scan(folder.path(), "bracket", "digital", 4, faults, 4));
}

TEST(ScaleInvariance, HoldsForSpatialUnwrappingAndALaserSheet) {
  const TemporaryFolder folder;
  expect_scales(small_scan(folder.path(), "bust", "angular", 5, {.samples_per_px = 4}, 4));
}

TEST(ScaleInvariance, HoldsForTwoSetups) {
  const TemporaryFolder folder;
  const Mesh part = make_part("bust");
  Scan plan;
  plan.folder = folder.path();
  plan.name = "bust";
  plan.rig = testing::small_rig("digital", 4);
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < 8; ++i)
    plan.views.push_back({kTwoPi * i / 4, "views/" + std::to_string(i), i / 4});
  plan.part_poses[1] = pose_on_table(part, rad_from_deg(90.0), 0.4);
  expect_scales(simulate_scan(part, plan, {.samples_per_px = 4}));
}

}  // namespace
}  // namespace frangia
