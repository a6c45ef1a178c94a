// A display of gamma 2.2, measured by a grey ramp and corrected in the patterns it shows.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/waveform/fringe_response.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/simulate/internal/render_view.h"

#include "support/small_scan.h"

namespace frangia {
namespace {

/// RMS of what the phases differ where both are measured, in rad.
double rms_apart(const WrappedPhase& found, const WrappedPhase& truth) {
  double square = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < found.status.pixels().size(); ++i) {
    const double error =
        wrap_rad(static_cast<double>(found.phase_rad.pixels()[i] - truth.phase_rad.pixels()[i]));
    if (std::isnan(error)) continue;
    square += error * error;
    count += 1.0;
  }
  EXPECT_GT(count, 1000.0);
  return std::sqrt(square / count);
}

/// RMS phase error of three 120 degree frames, which even and odd harmonics both bend, against
/// those of a display without gamma.
double phase_error(const Rig& rig, double gamma, ResponseCurve* measured) {
  PatternPlan plan{.periods_px = {40.0}, .shifts = 3, .ramp = 17};
  const auto patterns = default_patterns(rig, plan);
  const SimulatedView view{0, 0.1};
  const auto render = [&](const Rig& shown, double display_gamma) {
    SimulateOptions options;
    options.noise = false;
    options.bits = 16;
    options.display_gamma = display_gamma;
    return render_view(
        make_simulated_scene(make_part("plate"), shown, {&view, 1}, options), patterns, view);
  };
  Rig plain = rig;
  plain.projector.response.reset();
  const auto bent = render(rig, gamma);
  const auto true_frames = render(plain, 1.0);
  const PhaseAlgorithm algorithm = least_squares(patterns[0].shifts_rad);
  const WrappedPhase found = wrap_phase(bent[0], algorithm, {});
  const WrappedPhase truth = wrap_phase(true_frames[0], algorithm, {});
  if (measured != nullptr) *measured = measure_response({&bent[1], 1});
  return rms_apart(found, truth);
}

TEST(MeasureResponse, OfAGammaOf2_2TakesItsPhaseErrorAwayWhenPatternsAreCorrected) {
  Rig rig = testing::small_rig("digital", 4);
  ResponseCurve response;
  const double before = phase_error(rig, 2.2, &response);
  EXPECT_NEAR(response.light_of(0.5), std::pow(0.5, 2.2), 2e-3);
  EXPECT_GT(before, 0.1);
  rig.projector.response = response;
  EXPECT_LT(phase_error(rig, 2.2, nullptr), 0.005);
}

/// The plate through a display of gamma 2.2, or none, without noise.
std::vector<FrameStack> plate_frames(const Rig& rig, const PatternPlan& plan, double gamma) {
  const SimulatedView view{0, 0.1};
  SimulateOptions options;
  options.noise = false;
  options.bits = 16;
  options.display_gamma = gamma;
  return render_view(make_simulated_scene(make_part("plate"), rig, {&view, 1}, options),
                     default_patterns(rig, plan),
                     view);
}

TEST(MeasureFringeResponse, OfAGammaOf2_2IsThatOfTheRamp) {
  const Rig rig = testing::small_rig("digital", 4);
  const auto frames = plate_frames(rig, {.periods_px = {40.0}, .shifts = 8}, 2.2);
  ASSERT_TRUE(determines_response(frames[0].pattern));
  const ResponseCurve response = measure_fringe_response({frames.data(), 1});
  for (const double level : {0.25, 0.5, 0.75})
    EXPECT_NEAR(response.light_of(level), std::pow(level, 2.2), 0.01) << level;
}

TEST(MeasureFringeResponse, RefusesFourFrames) {
  const Rig rig = testing::small_rig("digital", 4);
  const auto frames = plate_frames(rig, {.periods_px = {40.0}, .shifts = 4}, 1.0);
  EXPECT_FALSE(determines_response(frames[0].pattern));
  EXPECT_THROW(static_cast<void>(measure_fringe_response({})), Error);
  EXPECT_THROW(static_cast<void>(measure_fringe_response({frames.data(), 1})), Error);
}

TEST(CorrectResponse, TakesThePhaseErrorOfAGammaOf2_2AwayInTheFramesDecoded) {
  const Rig rig = testing::small_rig("digital", 4);
  const PatternPlan plan{.periods_px = {40.0}, .shifts = 3};
  const auto bent = plate_frames(rig, plan, 2.2);
  const auto straight = plate_frames(rig, plan, 1.0);
  const std::vector<double>& shifts = bent[0].pattern.shifts_rad;
  const PhaseAlgorithm algorithm = least_squares(shifts);
  ResponseCurve gamma;
  for (int k = 0; k <= 256; ++k)
    gamma.light.push_back(std::pow(k / 256.0, 2.2));
  WrappedPhase found = wrap_phase(bent[0], algorithm, {});
  correct_response(response_table(gamma, algorithm, shifts), found);
  const WrappedPhase truth = wrap_phase(straight[0], algorithm, {});
  EXPECT_LT(rms_apart(found, truth), 0.005);  // above 0.1 without
}

TEST(MeasureResponse, RefusesAScanWithoutARampAndOneInTheDark) {
  EXPECT_THROW(static_cast<void>(measure_response({})), Error);
  FrameStack dark{
      .pattern = {.name = "ramp", .kind = PatternKind::Ramp, .levels = {0.0, 0.5, 1.0}}};
  for (int i = 0; i < 3; ++i)
    dark.frames.emplace_back(Image<std::uint8_t>(30, 20, 4));
  EXPECT_THROW(static_cast<void>(measure_response({&dark, 1})), Error);
}

}  // namespace
}  // namespace frangia
