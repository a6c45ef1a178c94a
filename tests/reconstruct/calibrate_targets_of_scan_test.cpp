#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/simulate/place_stickers.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::small_rig;
using testing::TemporaryFolder;

/// A plate that stands upright, and turned over; discs and markers on its faces.
class TargetsOfScan : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    const Mesh part = make_plate();
    SimulateOptions options{.samples_per_px = 4};
    options.targets = TargetSet{.diameter_mm = 7.0, .dictionary = "DICT_4X4_50", .marker_mm = 13.0};
    stickers = new std::vector<Sticker>(place_stickers(part, options.targets, 3, 3, 3));
    options.stickers = *stickers;
    Scan plan;
    plan.folder = folder->path() / "scan";
    plan.rig = small_rig("digital", 2);
    plan.patterns = default_patterns(plan.rig);
    for (int i = 0; i < 8; ++i)
      plan.views.push_back({kTwoPi * (i % 4) / 4 + 0.3, "views/" + std::to_string(i), i / 4});
    plan.part_poses[1] = pose_on_table(part, kPi, 0.4);
    plan.targets = options.targets;
    Scan scan = simulate_scan(part, plan, options);
    scan.part_poses.clear();
    // One distance as another instrument measured it: 1 % longer than the simulation has it.
    const auto place = [&](int code) {
      return std::find_if(stickers->begin(),
                          stickers->end(),
                          [code](const Sticker& one) { return one.code == code; })
          ->center_mm;
    };
    scan.targets->distances = {{0, 1, 1.01 * (place(0) - place(1)).norm(), 0.002}};
    ReconstructOptions reconstruction;
    reconstruction.fill_targets = true;
    result = new Reconstruction(reconstruct(scan, reconstruction));
  }
  static void TearDownTestSuite() {
    delete result;
    delete stickers;
    delete folder;
  }
  static inline TemporaryFolder* folder = nullptr;
  static inline std::vector<Sticker>* stickers = nullptr;
  static inline Reconstruction* result = nullptr;
};

TEST_F(TargetsOfScan, LieWhereTheyWereStuckButForTheScale) {
  ASSERT_TRUE(result->targets.has_value());
  EXPECT_TRUE(result->untrusted_reason.empty()) << result->untrusted_reason;
  std::size_t found = 0;
  for (const MeasuredTarget& target : result->targets->targets) {
    const bool known = std::any_of(stickers->begin(), stickers->end(), [&](const Sticker& one) {
      return one.code == target.code && (1.01 * one.center_mm - target.center_mm).norm() < 0.08;
    });
    EXPECT_TRUE(known) << target.code << " at " << target.center_mm.transpose();
    found += known ? 1 : 0;
  }
  EXPECT_GE(found, stickers->size() - 1);
  EXPECT_GE(result->targets->tying_setups, 4U);
  EXPECT_LT(result->targets->over_sigma, 2.0);
}

TEST_F(TargetsOfScan, GiveTheScaleByAKnownDistance) {
  ASSERT_TRUE(result->targets->scale.has_value());
  EXPECT_NEAR(result->targets->scale->factor, 1.01, 4.0 * result->targets->scale->sigma + 1e-4);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : result->mesh.vertices_mm)
    box.extend(vertex);
  EXPECT_NEAR(box.sizes().y(), 1.01 * 80.0, 0.5);
}

TEST_F(TargetsOfScan, AreNoSurfaceUnlessTheyAreFilled) {
  EXPECT_GT(result->targets->masked, 500U);
  EXPECT_GE(result->targets->filled, 4U);
  // Under a sticker is nothing but what was filled, and it is flat as the plate.
  const Mesh& mesh = result->mesh;
  ASSERT_FALSE(mesh.vertex_marks.empty());
  std::size_t inside = 0;
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    for (const Sticker& sticker : *stickers) {
      if (sticker.code >= 0) continue;
      const Eigen::Vector3d away = mesh.vertices_mm[i].cast<double>() / 1.01 - sticker.center_mm;
      const double height = away.dot(sticker.normal);
      if (std::abs(height) > 2.0 || (away - height * sticker.normal).norm() > 3.0) continue;
      ++inside;
      EXPECT_EQ(mesh.vertex_marks[i], Mark::Synthesized);
      EXPECT_LT(std::abs(height), 0.1);
    }
  }
  EXPECT_GT(inside, 20U);
}

TEST(FillTargets, NeedsTheTargetsOfTheScan) {
  const TemporaryFolder empty;
  const Scan scan = testing::small_scan(empty.path() / "scan", "plate", "digital", 1, {}, 8);
  ReconstructOptions options;
  options.fill_targets = true;
  EXPECT_THROW(static_cast<void>(reconstruct(scan, options)), Error);
}

}  // namespace
}  // namespace frangia
