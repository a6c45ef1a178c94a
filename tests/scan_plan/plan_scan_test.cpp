// Scans that are planned in software, and scans that go on until they are decided.
#include "frangia/scan_plan/plan_scan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/scan_plan/scan_until.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"

#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

InspectionPlan tolerance_of_surface(double mm) {
  InspectionPlan plan;
  plan.tolerance_mm = ToleranceLimits{-mm, mm};
  // What the plate stands on is seen by no station of one setup.
  plan.surface.max_gap_mm = 20.0;  // grooves
  plan.surface.excluded = {{"base", {-1000, -1000, -1000}, {1000, 1000, 0.01}}};
  return plan;
}

ScanPlanOptions first_alone() {
  ScanPlanOptions options;
  options.scan.divisor = 4;
  options.search = false;
  return options;
}

TEST(PlanScan, StatesTheUncertaintyOfAPartWithoutErrors) {
  const InspectionReference plate = reference_of_mesh(make_part("plate"));
  const ScanPlan wide =
      plan_scan(plate, tolerance_of_surface(1.0), rig_preset("digital"), first_alone());
  EXPECT_TRUE(wide.suffices) << sentence_of(wide.predicted.surface->verdict);
  EXPECT_EQ(wide.need, ScanNeed::Nothing);
  EXPECT_EQ(wide.tried.size(), 1U);
  // The map has the uncertainty of what stations see, and none below the part.
  std::size_t seen = 0;
  std::size_t below = 0;
  for (std::size_t v = 0; v < wide.map.u95_mm.size(); ++v) {
    seen += std::isfinite(wide.map.u95_mm[v]) ? 1U : 0U;
    const bool is_below = wide.map.mesh.vertices_mm[v].z() < 1e-3F;
    if (is_below && v % 3 == 0 && std::isfinite(wide.map.u95_mm[v])) ++below;
  }
  EXPECT_GT(seen, wide.map.u95_mm.size() / 3);
  EXPECT_LT(below, seen / 5);
  const ScanPlan narrow =
      plan_scan(plate, tolerance_of_surface(1e-4), rig_preset("digital"), first_alone());
  EXPECT_FALSE(narrow.suffices);
  EXPECT_NE(narrow.need, ScanNeed::Nothing);
}

/// Noise in the frames is what the prediction is made of.
TEST(PlanScan, PredictsMoreNoiseForADarkPart) {
  const InspectionReference plate = reference_of_mesh(make_part("plate"));
  ScanPlanOptions options = first_alone();
  const auto median_of = [&] {
    return plan_scan(plate, tolerance_of_surface(1.0), rig_preset("digital"), options)
        .predicted.surface->verdict.median_u_mm;
  };
  const double white = median_of();
  options.scan.reflectance = 0.1;
  EXPECT_GT(median_of(), 1.5 * white);
}

TEST(PlanScan, RefusesAPartThatTheRigDoesNotSee) {
  Mesh far = make_part("plate");
  for (auto& vertex : far.vertices_mm)
    vertex *= 1e-3F;
  const InspectionReference speck = reference_of_mesh(std::move(far));
  EXPECT_FALSE(testing::error_of([&] {
                 static_cast<void>(plan_scan(
                     speck, tolerance_of_surface(0.1), rig_preset("digital"), first_alone()));
               }).empty());
}

TEST(CoarserRig, KeepsTheFieldAndTheUncertaintyOfItsParameters) {
  Rig rig = rig_preset("digital");
  rig.calibration.emplace();
  rig.calibration->covariance = {{"camera.focal_px", "camera.k1", "projector.focal_px"},
                                 Eigen::Vector3d(4.0, 0.01, 9.0).asDiagonal()};
  const Rig coarse = coarser_rig(rig, 2);
  const CameraModel& model = coarse.reference().model;
  EXPECT_EQ(model.width_px, rig.reference().model.width_px / 2);
  // The corner of the image looks in the same direction.
  const Eigen::Vector2d corner = model.ray({-0.5, -0.5});
  EXPECT_LT((corner - rig.reference().model.ray({-0.5, -0.5})).norm(), 1e-9);
  const Eigen::MatrixXd& covariance = coarse.calibration->covariance.covariance;
  EXPECT_NEAR(covariance(0, 0), 1.0, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.01, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 9.0, 1e-12);
}

/// Scans of a plate by four stations and those between them, each in a folder of its own.
class ScanUntilDecided : public ::testing::Test {
 protected:
  ScanUntilDecided() {
    first_.name = "plate";
    first_.rig = testing::small_rig("digital", 4);
    first_.patterns = default_patterns(first_.rig);
    for (int i = 0; i < 4; ++i)
      first_.views.push_back({kTwoPi * i / 4, "views/" + std::to_string(i)});
  }

  ScanUntil scan(double tolerance_mm, std::size_t most_rounds = 3) {
    const CaptureViews capture = [&](const Scan& plan) {
      Scan all = plan;
      if (all.views.size() < captured_.size()) all.views = captured_;  // of an earlier session
      captured_ = all.views;
      all.folder = folder_.path() / std::to_string(scans_++);
      stations_.push_back(all.views.size());
      return simulate_scan(plate_, all, {.samples_per_px = 4});
    };
    InspectionPlan plan = tolerance_of_surface(tolerance_mm);
    plan.align = "none";
    return scan_until(first_, capture, reference_of_mesh(plate_), plan, most_rounds);
  }

  testing::TemporaryFolder folder_;
  Mesh plate_ = make_part("plate");
  Scan first_;
  int scans_ = 0;
  std::vector<std::size_t> stations_;  ///< of the scans of a session
  std::vector<ScanView> captured_;
};

TEST_F(ScanUntilDecided, AddsStationsBetweenTheOthersInTheSameSetup) {
  const ScanUntil done = scan(0.05);
  ASSERT_GE(done.rounds.size(), 2U);
  for (std::size_t round = 0; round < stations_.size(); ++round)
    EXPECT_EQ(stations_[round], 4 * (round + 1));
  std::set<double> angles;
  std::set<std::filesystem::path> folders;
  for (const ScanView& view : captured_) {
    EXPECT_EQ(view.setup, 0);
    angles.insert(view.angle_rad);
    folders.insert(view.folder);
  }
  EXPECT_EQ(angles.size(), captured_.size());
  EXPECT_EQ(folders.size(), captured_.size());
  // More stations decide more, or the answer says why they do not.
  EXPECT_GE(done.rounds[1].reach.decidable_share, done.rounds[0].reach.decidable_share - 0.01);
  EXPECT_FALSE(text_of(done.stop).empty());
}

TEST_F(ScanUntilDecided, StopsWhereAllIsDecided) {
  const ScanUntil done = scan(1.0);
  EXPECT_EQ(done.stop, ScanStop::Decided) << sentence_of(done.found.surface->verdict);
  EXPECT_EQ(done.found.verdict, Conformity::In);
  EXPECT_EQ(done.rounds.size(), stations_.size());
}

/// What an earlier session captured is not taken for a round that did not help.
TEST_F(ScanUntilDecided, GoesOnBehindTheRoundsOfAnEarlierSession) {
  static_cast<void>(scan(0.05, 2));
  ASSERT_EQ(stations_.size(), 2U);
  stations_.clear();
  const ScanUntil done = scan(0.05, 2);
  ASSERT_FALSE(done.rounds.empty());
  EXPECT_EQ(done.rounds.front().stations, 8U);
  EXPECT_NE(done.stop, ScanStop::NotHelped);
}

}  // namespace
}  // namespace frangia
