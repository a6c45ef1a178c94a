#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/reconstruct/merge_scans.h"

#include "support/grid_of_points.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

/// Three balls and the bar below them.
Mesh balls() {
  Mesh all = testing::box({-20.0F, -60.0F, 2.0F}, {20.0F, 60.0F, 8.0F});
  for (const Mesh& ball : {testing::sphere({0.0, -35.0, 60.0}, 20.0, 40),
                           testing::sphere({0.0, 35.0, 60.0}, 20.0, 40),
                           testing::sphere({8.0, 3.0, 45.0}, 12.0, 40)}) {
    const auto first = static_cast<std::uint32_t>(all.vertices_mm.size());
    all.vertices_mm.insert(all.vertices_mm.end(), ball.vertices_mm.begin(), ball.vertices_mm.end());
    for (const auto& [a, b, c] : ball.triangles)
      all.triangles.push_back({first + a, first + b, first + c});
  }
  all.normals.clear();
  return all;
}

/// What a scanner sees that looks at the part from the side and a little above, lit from its left:
/// a grid of points with noise in the frame of the part, joined to triangles.
RangeScan scan_of(const RayScene& part, double turn_rad, unsigned seed) {
  constexpr int kSide = 130;
  constexpr double kStep_mm = 1.0;
  constexpr double kNoise_mm = 0.03;
  const double above_rad = 0.4;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).matrix();
  const Eigen::Vector3d away =
      turn * Eigen::Vector3d(std::cos(above_rad), 0.0, std::sin(above_rad));
  const Eigen::Vector3d right = turn * Eigen::Vector3d::UnitY();
  const Eigen::Vector3d up = away.cross(right);
  const Eigen::Vector3d light = (away - 0.4 * right).normalized();
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kNoise_mm);
  RangeScan scan;
  std::vector<std::int64_t> number(std::size_t{kSide} * kSide, -1);
  std::vector<double> far(number.size(), 0.0);
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x = (i % kSide - kSide / 2) * kStep_mm;
    const double y = (i / kSide - kSide / 2) * kStep_mm;
    const Eigen::Vector3d from =
        Eigen::Vector3d(0.0, 0.0, 35.0) + x * right + y * up + 200.0 * away;
    const auto hit = part.first_hit(from, -away);
    if (!hit || hit->normal.dot(away) < 0.2 || hit->normal.dot(light) < 0.05) continue;
    const Eigen::Vector3d at = from - hit->distance * away;
    if (part.first_hit(at + 1e-3 * hit->normal, light)) continue;
    const auto pixel = static_cast<std::size_t>(i);
    number[pixel] = static_cast<std::int64_t>(scan.mesh.vertices_mm.size());
    far[pixel] = hit->distance;
    scan.mesh.vertices_mm.emplace_back((at + noise(random) * away).cast<float>());
  }
  const auto fits = [&](const std::array<std::size_t, 3>& places) {
    const auto [near, away_most] = std::minmax({far[places[0]], far[places[1]], far[places[2]]});
    return away_most - near < 6.0 * kStep_mm;
  };
  testing::join_grid(number, kSide, fits, scan.mesh);
  return scan;
}

TEST(DoubtfulPoses, AreKeptUnlessOthersFitFarBetter) {
  const RayScene part(balls());
  std::vector<RangeScan> scans;
  for (unsigned i = 0; i < 8; ++i)
    scans.push_back(scan_of(part, i * kPi / 4.0, i + 1));
  std::string notes;
  frangia::Run run;
  run.on_note = [&](const std::string& sentence) { notes += sentence + "\n"; };
  const MergedScans merged = merge_scans(scans, {}, run);
  EXPECT_FALSE(merged.found_poses.has_value());
  EXPECT_NE(notes.find("the given ones are kept"), std::string::npos) << notes;
  for (const MergedScan& scan : merged.scans)
    EXPECT_LT((scan.world_from_scan.matrix() - Eigen::Matrix4d::Identity()).norm(), 0.3)
        << scan.name;
}

}  // namespace
}  // namespace frangia
