// Frames beside a Gray code that are out of step all through a view; made by the published
// formulas.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/decode_view.h"
#include "frangia/decode/explain/explain_lag.h"

namespace frangia {
namespace {

constexpr int kCodedAcross_px = 360;
constexpr int kCodedDown_px = 40;
constexpr double kStripe_px = 10.0;

double coded_column_at(int x, int y) {
  return 20.0 + 1.7 * x + 8.0 * std::sin(0.03 * x + 0.1 * y);
}

/// Light from 0 to 1 at a column of the projector.
using LightAt = std::function<double(double)>;

LightAt stripes(int bit, bool inverted) {
  return [=](double column) {
    const auto number = static_cast<unsigned>(std::floor((column + 0.5) / kStripe_px));
    const bool bright = ((number ^ (number / 2)) >> static_cast<unsigned>(bit)) % 2 == 1;
    return bright != inverted ? 1.0 : 0.0;
  };
}

LightAt fringes_of(double period_px, double shift_rad) {
  return
      [=](double column) { return 0.5 + 0.5 * std::cos(kTwoPi * column / period_px + shift_rad); };
}

struct CodedScan {
  int steps = 4;
  int lag = 0;
  bool code_first = true;
  InvertedFrames inverted = InvertedFrames::None;
  double period_px = 2.0 * kStripe_px;
};

/// The stacks of a code of 6 bits and fringes, whose frames show what should be seen `lag` before.
std::vector<FrameStack> coded(const CodedScan& scan) {
  FrameStack code;
  code.pattern = {.name = "code", .kind = PatternKind::Gray, .bits = 6, .stripe_px = kStripe_px};
  code.pattern.inverted = scan.inverted;
  std::vector<LightAt> of_code;
  for (int bit = 5; bit >= 0; --bit) {
    of_code.push_back(stripes(bit, false));
    if (scan.inverted == InvertedFrames::Alternating) of_code.push_back(stripes(bit, true));
  }
  for (int bit = 5; bit >= 0 && scan.inverted == InvertedFrames::After; --bit)
    of_code.push_back(stripes(bit, true));
  FrameStack fringes;
  fringes.pattern = {.name = "fringes", .period_px = scan.period_px, .shifts_rad = {}};
  std::vector<LightAt> shown;
  for (int k = 0; k < scan.steps; ++k) {
    fringes.pattern.shifts_rad.push_back(kTwoPi * k / scan.steps);
    shown.push_back(fringes_of(scan.period_px, fringes.pattern.shifts_rad.back()));
  }
  shown.insert(scan.code_first ? shown.begin() : shown.end(), of_code.begin(), of_code.end());
  std::vector<FrameStack> stacks;
  stacks.push_back(scan.code_first ? std::move(code) : std::move(fringes));
  stacks.push_back(scan.code_first ? std::move(fringes) : std::move(code));
  std::mt19937 generator(11);
  std::normal_distribution<double> noise(0.0, 1.5);
  int place = -scan.lag;
  for (FrameStack& stack : stacks) {
    for (int k = 0; k < stack.pattern.frame_count(); ++k, ++place) {
      const bool is_shown = place >= 0 && place < static_cast<int>(shown.size());
      Image<std::uint8_t> frame(kCodedAcross_px, kCodedDown_px);
      for (int y = 0; y < kCodedDown_px; ++y) {
        for (int x = 0; x < kCodedAcross_px; ++x) {
          const double light =
              is_shown ? shown[static_cast<std::size_t>(place)](coded_column_at(x, y)) : 0.0;
          const double counts = 12.0 + (120.0 + 50.0 * std::cos(0.013 * x + 0.05 * y)) * light;
          frame(x, y) = static_cast<std::uint8_t>(
              std::lround(std::clamp(counts + noise(generator), 0.0, 254.0)));
        }
      }
      stack.frames.emplace_back(std::move(frame));
    }
  }
  return stacks;
}

Rig rig_of_coded() {
  Rig rig;
  rig.reference().model.width_px = kCodedAcross_px;
  rig.reference().model.height_px = kCodedDown_px;
  rig.projector.model = CameraModel{.width_px = 640, .height_px = 480};
  return rig;
}

std::string text_of(const CodedScan& scan) {
  return std::to_string(scan.steps) + " steps, late by " + std::to_string(scan.lag) +
         (scan.code_first ? ", code first" : ", code last") +
         (scan.inverted == InvertedFrames::None ? "" : ", inverses") + ", period " +
         std::to_string(scan.period_px);
}

TEST(LagBesideAGrayCode, IsNamedByTheOrderThatTheCodeGives) {
  for (const int steps : {3, 4, 6}) {
    for (const int lag : {1, 2}) {
      for (const InvertedFrames inverted : {InvertedFrames::None, InvertedFrames::After}) {
        const CodedScan scan{.steps = steps, .lag = lag, .inverted = inverted};
        if (steps - lag < 3) continue;  // what is left of the fringes has no phase
        const DecodedView view = decode_view(coded(scan), rig_of_coded(), {});
        const auto& check = view.directions.front().check;
        ASSERT_TRUE(check);
        EXPECT_FALSE(check->consistent) << text_of(scan);
        EXPECT_EQ(check->finding.find(lag == 1 ? "all frames are late by one frame"
                                               : "all frames are late by two frames"),
                  0U)
            << text_of(scan) << ": " << describe(*check);
      }
    }
  }
}

TEST(LagBesideAGrayCode, IsNamedWhereTheCodeLacksItsLastFrames) {
  for (const int steps : {3, 6}) {
    for (const int lag : {1, 2}) {
      for (const InvertedFrames inverted :
           {InvertedFrames::None, InvertedFrames::After, InvertedFrames::Alternating}) {
        // What is left of a code has to be as fine as the fringes.
        const CodedScan scan{.steps = steps,
                             .lag = lag,
                             .code_first = false,
                             .inverted = inverted,
                             .period_px = 4.0 * kStripe_px};
        const DecodedView view = decode_view(coded(scan), rig_of_coded(), {});
        const auto& check = view.directions.front().check;
        ASSERT_TRUE(check);
        EXPECT_NE(check->finding.find("all frames are late by "), std::string::npos)
            << text_of(scan) << ": " << describe(*check);
      }
    }
  }
}

TEST(LagBesideAGrayCode, IsNotSeenInSoundFramesAndInOtherFaults) {
  for (const int steps : {3, 4, 6}) {
    for (const bool first : {true, false}) {
      const CodedScan scan{.steps = steps, .code_first = first};
      std::vector<FrameStack> stacks = coded(scan);
      EXPECT_FALSE(explain_lag_by_code(stacks)) << text_of(scan);
      const std::size_t of_fringes = first ? 1 : 0;
      std::swap(stacks[of_fringes].frames[0], stacks[of_fringes].frames[1]);
      EXPECT_FALSE(explain_lag_by_code(stacks)) << text_of(scan);
      std::swap(stacks[of_fringes].frames[0], stacks[of_fringes].frames[1]);
      std::swap(stacks[1 - of_fringes].frames[1], stacks[1 - of_fringes].frames[4]);
      EXPECT_FALSE(explain_lag_by_code(stacks)) << text_of(scan);
    }
  }
}

TEST(LagBesideAGrayCode, IsNotSeenInOnePatternThatIsNotAsDescribed) {
  for (const int steps : {4, 6}) {
    for (const double period_px : {2.0 * kStripe_px, 4.0 * kStripe_px}) {
      const CodedScan scan{.steps = steps, .code_first = false, .period_px = period_px};
      const std::vector<FrameStack> sound = coded(scan);
      std::vector<FrameStack> reversed = sound;
      for (double& shift : reversed.front().pattern.shifts_rad)
        shift = -shift;
      EXPECT_FALSE(explain_lag_by_code(reversed)) << text_of(scan);
      std::vector<FrameStack> other_period = sound;
      other_period.front().pattern.period_px *= 0.9;
      EXPECT_FALSE(explain_lag_by_code(other_period)) << text_of(scan);
      for (std::size_t lost = 0; lost < sound.back().frames.size(); ++lost) {
        std::vector<FrameStack> white = sound;
        white.back().frames[lost] =
            Image<std::uint8_t>(kCodedAcross_px, kCodedDown_px, std::uint8_t{240});
        EXPECT_FALSE(explain_lag_by_code(white)) << text_of(scan) << ", frame " << lost;
      }
    }
  }
}

TEST(LagBesideAGrayCode, IsDecodedAsWhatTheFramesShowIfThatIsAccepted) {
  const CodedScan scan{.steps = 6, .lag = 1};
  const DecodedView view = decode_view(coded(scan), rig_of_coded(), {}, {.accept_remedy = true});
  const AbsolutePhase& phase = view.directions.front().phase;
  double square = 0.0;
  int measured = 0;
  for (int y = 0; y < kCodedDown_px; ++y) {
    for (int x = 0; x < kCodedAcross_px; ++x) {
      const auto found = static_cast<double>(phase.phase_rad(x, y));
      if (std::isnan(found)) continue;
      const double over =
          (found - kTwoPi * coded_column_at(x, y) / scan.period_px) / phase.sigma_rad(x, y);
      square += over * over;
      ++measured;
    }
  }
  EXPECT_GT(measured, kCodedAcross_px * kCodedDown_px * 8 / 10);
  EXPECT_NEAR(std::sqrt(square / measured), 1.0, 0.25);
}

}  // namespace
}  // namespace frangia
