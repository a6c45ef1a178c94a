// A view of a rolling shutter in light that flickers, made by the published formulas.
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/decode_view.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {
namespace {

/// Fringes of six steps, with bands of 6 % over the rows of each frame.
FrameStack banded_fringes() {
  FrameStack stack;
  stack.pattern = {.name = "f", .period_px = 20.0, .shifts_rad = {}};
  for (int k = 0; k < 6; ++k) {
    stack.pattern.shifts_rad.push_back(kTwoPi * k / 6);
    Image<std::uint8_t> frame(240, 160);
    for (int y = 0; y < frame.height(); ++y) {
      const double gain = 0.06 * std::sin(kTwoPi * (3.0 * y / frame.height() + k / 6.0));
      for (int x = 0; x < frame.width(); ++x) {
        const double phase = 0.5 * x + std::sin(0.05 * y) + stack.pattern.shifts_rad.back();
        const double light = 90.0 + 70.0 * std::cos(phase);
        frame(x, y) = static_cast<std::uint8_t>(std::lround(light * (1.0 + gain)));
      }
    }
    stack.frames.emplace_back(std::move(frame));
  }
  return stack;
}

TEST(BandsInAView, AreTakenOutButOfTheFramesThatAnOwnFunctionWraps) {
  const std::vector<FrameStack> captured{banded_fringes()};
  Rig rig;
  rig.reference().model.width_px = 240;
  rig.reference().model.height_px = 160;
  rig.projector.model = CameraModel{.width_px = 640, .height_px = 480};
  int warned = 0;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) {
    warned += sentence.find("differs from row to row") != std::string::npos ? 1 : 0;
  };
  static_cast<void>(decode_view(captured, rig, {}, {}, run));
  EXPECT_EQ(warned, 1);

  DecodeOptions own;
  int seen = 0;
  own.own.wrap =
      [&](const FrameStack& stack, const FittedAlgorithm& fitted, const NoiseModel& noise) {
        seen = counts_at(stack.frames[2], 50, 40);
        return wrap_phase(stack, fitted.algorithm, noise);
      };
  static_cast<void>(decode_view(captured, rig, {}, own, run));
  EXPECT_EQ(warned, 1);
  EXPECT_EQ(seen, counts_at(captured.front().frames[2], 50, 40));
}

}  // namespace
}  // namespace frangia
