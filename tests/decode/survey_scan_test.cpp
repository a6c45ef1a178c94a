#include "frangia/decode/survey_scan.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "frangia/dataset/read_frames.h"
#include "frangia/decode/decode_view.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::small_scan;
using testing::TemporaryFolder;

/// 20 000 electrons at 255 counts and 8 electrons read, as `simulate` makes them by default.
double true_variance(double counts) {
  return NoiseModel::from_camera(20000.0 / 255.0, 8.0).variance(counts);
}

TEST(SurveyScan, FindsTheNoiseOfACameraThatTheRigSaysNothingOf) {
  const TemporaryFolder folder;
  Scan scan = small_scan(folder.path(), "shaft", "digital", 4);
  scan.rig.reference().noise.reset();
  const ScanSurvey survey = survey_scan(scan);
  ASSERT_TRUE(survey.noise);
  EXPECT_TRUE(survey.gain_error.empty());  // a digital projector's shifts are exact
  for (const double counts : {30.0, 80.0, 140.0})
    EXPECT_NEAR(survey.noise->variance(counts) / true_variance(counts), 1.0, 0.1) << counts;
  // And decoding a view goes by it.
  DecodeOptions options;
  options.survey = survey;
  const auto rays = rays_of(scan.rig.reference().model);
  const DecodedView view = decode_view(read_frames(scan, 1), scan.rig, rays, options);
  EXPECT_EQ(view.noise.slope_counts, survey.noise->slope_counts);
}

TEST(SurveyScan, IsNeededForNothingThatTheRigGives) {
  const TemporaryFolder folder;
  Scan scan = small_scan(folder.path(), "plate", "digital", 2, {}, 4);
  scan.rig.reference().noise = NoiseModel::from_camera(50.0, 10.0);
  scan.folder = "/nowhere";  // and no frame is read
  const ScanSurvey survey = survey_scan(scan);
  EXPECT_FALSE(survey.noise);
}

TEST(SurveyScan, FindsTheGainOfAPhaseShifterAndDecodingTakesItOff) {
  const TemporaryFolder folder;
  SimulateOptions faults;
  faults.step_error = 0.05;
  const Scan scan = small_scan(folder.path(), "plate", "angular", 4, faults);
  std::string told;
  frangia::Run run;
  run.on_note = [&](const std::string& sentence) { told = sentence; };
  DecodeOptions options;
  options.survey = survey_scan(scan, run);
  ASSERT_EQ(options.survey.gain_error.size(), 1U);
  EXPECT_NEAR(options.survey.gain_error.begin()->second, 0.05, 5e-4);
  EXPECT_NE(told.find("+5.0"), std::string::npos) << told;
}

TEST(SurveyScan, TakesUnevenStepsForNoGain) {
  const TemporaryFolder folder;
  SimulateOptions faults;
  faults.step_jitter_rad = rad_from_deg(2.0);
  const Scan scan = small_scan(folder.path(), "plate", "angular", 8, faults, 4);
  const ScanSurvey survey = survey_scan(scan);
  ASSERT_EQ(survey.gain_error.size(), 1U);
  EXPECT_LT(std::abs(survey.gain_error.begin()->second), 2e-3);  // a view alone shows up to 2 %
}

}  // namespace
}  // namespace frangia
