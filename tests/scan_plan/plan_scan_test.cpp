// Scans that are planned in software, and scans that go on until they are decided.
#include "frangia/scan_plan/plan_scan.h"

#include <algorithm>
#include <cmath>

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

/// Simulated rounds, each a folder of its own with all views so far.
TEST(ScanUntil, AddsStationsBetweenTheOthersUntilAllIsDecided) {
  const testing::TemporaryFolder folder;
  const Mesh plate = make_part("plate");
  const InspectionReference reference = reference_of_mesh(plate);
  Scan first;
  first.name = "plate";
  first.rig = testing::small_rig("digital", 4);
  first.patterns = default_patterns(first.rig);
  for (int i = 0; i < 4; ++i)
    first.views.push_back({kTwoPi * i / 4, "views/" + std::to_string(i)});
  std::vector<std::size_t> stations;
  Scan all = first;
  all.views.clear();
  const CaptureSetup capture = [&](const Scan& plan, int setup) {
    for (const ScanView& view : plan.views) {
      EXPECT_EQ(view.setup, setup);
      all.views.push_back(
          {view.angle_rad, "views/" + std::to_string(all.views.size()), view.setup});
    }
    stations.push_back(all.views.size());
    all.folder = folder.path() / std::to_string(setup);
    return simulate_scan(plate, all, {.samples_per_px = 4});
  };
  InspectionPlan plan = tolerance_of_surface(1.0);
  plan.align = "none";
  const ScanUntil decided = scan_until(first, capture, reference, plan, 3);
  EXPECT_EQ(decided.stop, ScanStop::Decided) << sentence_of(decided.found.surface->verdict);
  EXPECT_EQ(decided.rounds.size(), stations.size());
  for (std::size_t round = 0; round < stations.size(); ++round)
    EXPECT_EQ(stations[round], 4 * (round + 1));
}

}  // namespace
}  // namespace frangia
