// The systematic part of the phase's uncertainty on its way through decode_view.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/decode/decode_view.h"
#include "frangia/simulate/internal/render_view.h"

#include "support/small_scan.h"

namespace frangia {
namespace {

struct DecodedPlate {
  Rig rig = testing::small_rig("digital", 4);
  Image<Eigen::Vector2f> rays = rays_of(rig.reference().model);
  std::vector<FrameStack> stacks;

  DecodedPlate(const PatternPlan& plan, double gamma, double flicker = 0.0) {
    const SimulatedView view{0, 0.1};
    SimulateOptions options;
    options.display_gamma = gamma;
    options.flicker = flicker;
    stacks = render_view(make_simulated_scene(make_part("plate"), rig, {&view, 1}, options),
                         default_patterns(rig, plan),
                         view);
  }
  [[nodiscard]] DecodedDirection decode(const DecodeOptions& options) const {
    return decode_view(stacks, rig, rays, options).directions.front();
  }
};

/// Mean systematic part of the measured pixels; -1 if the map is empty.
double mean_systematic(const AbsolutePhase& phase) {
  if (phase.systematic_rad.empty()) return -1.0;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < phase.status.pixels().size(); ++i) {
    const float value = phase.systematic_rad.pixels()[i];
    EXPECT_EQ(std::isnan(value), std::isnan(phase.phase_rad.pixels()[i]));
    if (std::isnan(value)) continue;
    sum += value;
    count += 1.0;
  }
  return sum / count;
}

TEST(DecodeView, CarriesTheErrorOfHarmonicsToTheAbsolutePhaseOnEveryPath) {
  const PatternPlan hierarchy{.periods_px = {1280.0, 160.0, 20.0}, .shifts = 3};
  const DecodedPlate plate(hierarchy, 1.8);
  const double separate =
      mean_systematic(plate.decode({.undo_own_response = false, .keep_maps = true}).phase);
  const double at_once =
      mean_systematic(plate.decode({.undo_own_response = false, .keep_maps = false}).phase);
  EXPECT_NEAR(separate, 0.148, 0.01);
  EXPECT_NEAR(at_once, separate, 0.002);
  const DecodedPlate gray({.sequence = "gray", .fringes = 64.0, .shifts = 3}, 1.8);
  EXPECT_NEAR(mean_systematic(gray.decode({.undo_own_response = false}).phase), 0.149, 0.01);
  const DecodedPlate single({.periods_px = {20.0}, .shifts = 3}, 1.8);
  EXPECT_NEAR(mean_systematic(single.decode({.undo_own_response = false}).phase), 0.149, 0.01);
}

TEST(DecodeView, HasNoSystematicPartForALinearProjectorOrAfterTheCorrection) {
  const PatternPlan plan{.periods_px = {1280.0, 160.0, 20.0}, .shifts = 3};
  for (const bool keep_maps : {true, false})
    EXPECT_EQ(mean_systematic(DecodedPlate(plan, 1.0).decode({.keep_maps = keep_maps}).phase),
              -1.0);
  const DecodedPlate plate(plan, 1.8);
  const DecodedDirection corrected = plate.decode({});  // the default
  EXPECT_LT(mean_systematic(corrected.phase), 0.01);
  for (const FrameAssessment& assessment : corrected.assessments)
    EXPECT_TRUE(assessment.harmonics_corrected);
  EXPECT_NE(describe_corrections(corrected.assessments).find("the response of the projector"),
            std::string::npos);
  EXPECT_EQ(describe_corrections(DecodedPlate(plan, 1.0).decode({}).assessments), "");
}

TEST(DecodeView, SaysThatFlickerOfMergedExposuresIsCounted) {
  PatternPlan plan{.periods_px = {1280.0, 160.0, 20.0}, .shifts = 6};
  const DecodedDirection one = DecodedPlate(plan, 1.0, 0.03).decode({});
  plan.exposures_ms = {8.0, 4.0};
  const DecodedDirection two = DecodedPlate(plan, 1.0, 0.03).decode({});
  EXPECT_GT(one.assessments.back().flicker, 0.01) << "is compensated";
  const FrameAssessment& merged = two.assessments.back();
  EXPECT_EQ(merged.flicker, 0.0) << "the weights of the exposures compensate nothing";
  EXPECT_GT(merged.flicker_error_rad, 0.005);
  for (const std::string& finding : findings(merged))
    EXPECT_EQ(finding.find("compensated"), std::string::npos) << finding;
}

}  // namespace
}  // namespace frangia
