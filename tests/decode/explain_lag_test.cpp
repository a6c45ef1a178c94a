// Frames that are out of step with the projector all through a view; made by the published
// formulas.
#include "frangia/decode/explain/explain_lag.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/decode_view.h"

namespace frangia {
namespace {

constexpr int kLagAcross_px = 400;
constexpr int kLagDown_px = 64;

double column_at(int x, int y) {
  return 40.0 + 2.5 * x + 8.0 * std::sin(0.03 * x + 0.1 * y);
}

/// What the projector shows in one frame.
struct Light {
  double period_px;  ///< 0: nothing
  double shift_rad;
};

/// A frame of an uneven part in the light of a room, with the second harmonic of a projector.
Image<std::uint8_t> lag_frame_of(const Light& light, double harmonic, std::mt19937& generator) {
  std::normal_distribution<double> noise(0.0, 1.5);
  Image<std::uint8_t> image(kLagAcross_px, kLagDown_px);
  for (int y = 0; y < kLagDown_px; ++y) {
    for (int x = 0; x < kLagAcross_px; ++x) {
      const double bright = 60.0 + 30.0 * std::cos(0.013 * x + 0.05 * y);
      double counts = 12.0;
      if (light.period_px > 0.0) {
        const double phase = kTwoPi * column_at(x, y) / light.period_px + light.shift_rad;
        counts += bright * (1.0 + 0.8 * std::cos(phase) + harmonic * std::cos(2.0 * phase));
      }
      image(x, y) =
          static_cast<std::uint8_t>(std::lround(std::clamp(counts + noise(generator), 0.0, 254.0)));
    }
  }
  return image;
}

/// Patterns of 1280, 160 and 20 px in `steps` frames each, whose frames show what should be seen
/// `lag` frames before; dark before the first and behind the last.
std::vector<FrameStack> captured(int steps, int lag, double harmonic = 0.0) {
  std::mt19937 generator(7);
  std::vector<FrameStack> stacks;
  std::vector<Light> shown;
  for (const double period : {1280.0, 160.0, 20.0}) {
    FrameStack stack;
    stack.pattern = {.name = std::to_string(static_cast<int>(period)), .period_px = period};
    stack.pattern.shifts_rad.clear();
    for (int k = 0; k < steps; ++k) {
      stack.pattern.shifts_rad.push_back(kTwoPi * k / steps);
      shown.push_back({period, kTwoPi * k / steps});
    }
    stacks.push_back(std::move(stack));
  }
  int place = -lag;
  for (FrameStack& stack : stacks) {
    for (int k = 0; k < steps; ++k, ++place) {
      const bool is_shown = place >= 0 && place < static_cast<int>(shown.size());
      const Light light = is_shown ? shown[static_cast<std::size_t>(place)] : Light{0.0, 0.0};
      stack.frames.emplace_back(lag_frame_of(light, harmonic, generator));
    }
  }
  return stacks;
}

TEST(ExplainLag, FindsFramesThatAreLateOrEarlyAllThrough) {
  for (const int steps : {3, 4, 6, 12}) {
    for (const int lag : {1, 2, 3, -1}) {
      for (const double harmonic : {0.0, 0.12}) {
        if (steps == lag) continue;  // each pattern is another one, as described
        const std::optional<FrameLag> found = explain_lag(captured(steps, lag, harmonic));
        ASSERT_TRUE(found) << steps << " steps, " << lag << " late, harmonic " << harmonic;
        EXPECT_EQ((found->frames - lag) % steps, 0)
            << steps << " steps, " << lag << " late, found " << found->frames;
        // Frames beyond the sequence may tell a lag from one that is a pattern longer.
        const bool whole_pattern = (lag == -1 && steps < 5) || lag == steps - 1;
        EXPECT_LE(found->explanation.best.size(), whole_pattern ? 2U : 1U) << steps << " " << lag;
        if (!whole_pattern) {
          EXPECT_EQ(found->frames, lag);
        }
      }
    }
  }
}

TEST(ExplainLag, BlamesNoFramesInStep) {
  for (const int steps : {3, 4, 6, 12}) {
    for (const double harmonic : {0.0, 0.12, 0.3})
      EXPECT_FALSE(explain_lag(captured(steps, 0, harmonic))) << steps << " " << harmonic;
    std::vector<FrameStack> other_start = captured(steps, 0);
    for (FrameStack& stack : other_start)
      std::rotate(stack.frames.begin(), stack.frames.begin() + 1, stack.frames.end());
    EXPECT_FALSE(explain_lag(other_start)) << steps;
    std::vector<FrameStack> lost = captured(steps, 0);
    std::mt19937 generator(9);
    lost[1].frames[1] = lag_frame_of({0.0, 0.0}, 0.0, generator);
    EXPECT_FALSE(explain_lag(lost)) << steps;
    for (const std::size_t patterns : {2U, 3U}) {
      for (std::size_t i = 0; i < patterns; ++i) {
        std::vector<FrameStack> exchanged = captured(steps, 0);
        exchanged.resize(patterns);
        std::swap(exchanged[i].frames[1], exchanged[i].frames[2]);
        EXPECT_FALSE(explain_lag(exchanged)) << steps << ", pattern " << i << " of " << patterns;
        std::vector<FrameStack> black = captured(steps, 0);
        black.resize(patterns);
        black[i].frames[0] = lag_frame_of({0.0, 0.0}, 0.0, generator);
        EXPECT_FALSE(explain_lag(black)) << steps << ", pattern " << i << " of " << patterns;
      }
    }
  }
}

TEST(ExplainLag, SaysNothingOfOnePatternOfSeveralExposuresOrOfFramesOfSeveralSizes) {
  std::vector<FrameStack> one = captured(4, 1);
  one.resize(1);
  EXPECT_FALSE(explain_lag(one));
  std::vector<FrameStack> bracketed = captured(4, 1);
  for (FrameStack& stack : bracketed)
    stack.pattern.exposures_ms = {8.0, 2.0};
  EXPECT_FALSE(explain_lag(bracketed));
  EXPECT_FALSE(explain_lag({}));
  std::vector<FrameStack> uneven = captured(4, 1);
  uneven[2].frames[1] = Image<std::uint8_t>(8, 8);
  EXPECT_FALSE(explain_lag(uneven));
}

TEST(InStep, GivesEachPatternTheFramesThatShowIt) {
  const std::vector<FrameStack> late = captured(4, 1);
  const std::vector<FrameStack> moved = in_step(late, {.frames = 1});
  ASSERT_EQ(moved.size(), 3U);
  for (const int x : {3, 50, 220})
    EXPECT_EQ(counts_at(moved[0].frames[3], x, 20), counts_at(late[1].frames[0], x, 20));
  EXPECT_EQ(moved[2].frames.size(), 3U);
  EXPECT_EQ(moved[2].pattern.shifts_rad.size(), 3U);
  const std::vector<FrameStack> early = in_step(captured(4, -1), {.frames = -1});
  ASSERT_EQ(early.size(), 3U);
  EXPECT_NEAR(early[0].pattern.shifts_rad.front(), 0.5 * kPi, 1e-12);
  EXPECT_TRUE(in_step(captured(3, 1), {.frames = 1}).empty());  // two of the finest are left
}

/// A rig of which the frames alone are decoded.
Rig rig_of_frames() {
  Rig rig;
  rig.reference().model.width_px = kLagAcross_px;
  rig.reference().model.height_px = kLagDown_px;
  rig.projector.model = CameraModel{.width_px = 1280, .height_px = 720};
  return rig;
}

TEST(DecodeView, DecodesFramesThatAreLateAsWhatTheyShowIfThatIsAccepted) {
  const std::vector<FrameStack> late = captured(4, 1);
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const DecodedView refused = decode_view(late, rig_of_frames(), {}, {}, run);
  const DecodedDirection& direction = refused.directions.front();
  ASSERT_TRUE(direction.check);
  EXPECT_FALSE(direction.check->consistent);
  EXPECT_EQ(direction.check->finding.find("all frames are late by one frame: "), 0U)
      << direction.check->finding;
  EXPECT_NE(direction.check->finding.find("accept_remedy"), std::string::npos);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  ASSERT_EQ(direction.frames.size(), 3U);
  EXPECT_EQ(direction.frames[0].explanation.best.cause, FrameCause::Late);

  const DecodedView used = decode_view(late, rig_of_frames(), {}, {.accept_remedy = true}, run);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("decoded as what they show"), std::string::npos) << warnings[0];
  const AbsolutePhase& phase = used.directions.front().phase;
  double square = 0.0;
  int measured = 0;
  for (int y = 0; y < kLagDown_px; ++y) {
    for (int x = 0; x < kLagAcross_px; ++x) {
      const auto found = static_cast<double>(phase.phase_rad(x, y));
      if (std::isnan(found)) continue;
      const double over = (found - kTwoPi * column_at(x, y) / 20.0) / phase.sigma_rad(x, y);
      square += over * over;
      ++measured;
    }
  }
  EXPECT_GT(measured, kLagAcross_px * kLagDown_px * 9 / 10);
  EXPECT_NEAR(std::sqrt(square / measured), 1.0, 0.2);
}

TEST(JudgeLag, AdvisesALongerDelayForLateFramesAlone) {
  const std::vector<Pattern> patterns{captured(4, 0).front().pattern};
  const auto remedy = [&](int frames) {
    return judge_lag(patterns, {.frames = frames}, false).front().explanation.explanation.remedy;
  };
  EXPECT_NE(remedy(1).find("delay_s"), std::string::npos);
  EXPECT_EQ(remedy(-1).find("delay_s"), std::string::npos);
}

TEST(DecodeView, OffersNoRemedyForLateFramesThatLackTheFinestPattern) {
  const DecodedView view =
      decode_view(captured(3, 1), rig_of_frames(), {}, {.accept_remedy = true});
  const auto& check = view.directions.front().check;
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->consistent);
  EXPECT_EQ(check->finding.find("accept_remedy"), std::string::npos) << check->finding;
}

}  // namespace
}  // namespace frangia
