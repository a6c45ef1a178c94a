#include "frangia/acquisition/internal/wait_for_drift.h"

#include <cmath>
#include <numbers>

#include "frangia/core/error.h"
#include "frangia/dataset/read_frames.h"

#include "support/simulated_capture.h"

namespace frangia {
namespace {

/// Fringes over a sloping brightness, moved by a phase, with light of the room.
FrameStack fringes(double moved_rad, double room_counts) {
  FrameStack stack{{.name = "fine", .period_px = 16.0}, {}, 4095};
  stack.pattern.shifts_rad = {
      0.0, 0.5 * std::numbers::pi, std::numbers::pi, 1.5 * std::numbers::pi};
  for (const double shift : stack.pattern.shifts_rad) {
    Image<std::uint16_t> image(96, 64);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 96; ++x) {
        const double light = 400.0 + 8.0 * x;
        const double wave = std::cos(2.0 * std::numbers::pi * x / 16.0 + shift + moved_rad);
        image(x, y) = static_cast<std::uint16_t>(
            std::lround(room_counts + light * (x < 48 ? 0.0 : 1.0 + 0.8 * wave)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

TEST(FringeMotion, IsThePhaseByWhichLitFringesMovedWhateverTheRoomLight) {
  EXPECT_NEAR(fringe_motion_rad(fringes(0.2, 100.0), fringes(0.2, 300.0)), 0.0, 1e-4);
  EXPECT_NEAR(fringe_motion_rad(fringes(0.2, 100.0), fringes(0.27, 300.0)), 0.07, 1e-3);
  EXPECT_NEAR(fringe_motion_rad(fringes(0.0, 100.0), fringes(-0.5, 100.0)), 0.5, 1e-3);
}

class WaitForDrift : public testing::SimulatedCapture {
 protected:
  WaitForDrift() {
    use("digital", 8);
    views(1);
  }
  /// Mean difference of the last frames of two scans.
  static double difference(const Scan& one, const Scan& other) {
    const Frame a = read_frames(one, 0).back().frames.back();
    const Frame b = read_frames(other, 0).back().frames.back();
    const auto sum = [](const auto& x, const auto& y) {
      double total = 0.0;
      for (std::size_t i = 0; i < x.pixels().size(); ++i)
        total += std::abs(static_cast<double>(x.pixels()[i]) - static_cast<double>(y.pixels()[i]));
      return total / static_cast<double>(x.pixels().size());
    };
    return std::visit([&](const auto& x) { return sum(x, std::get<std::decay_t<decltype(x)>>(b)); },
                      a);
  }
  Scan captured(const std::string& name, const CaptureOptions& options) {
    plan_.folder = folder_.path() / name;
    report_ = capture(options);
    return read_scan(plan_.folder);
  }
  CaptureReport report_;
};

TEST_F(WaitForDrift, BeginsWhenTheRigIsWarm) {
  const Scan warm = captured("warm", {});
  EXPECT_FALSE(report_.drift_mm.has_value());
  devices_["camera"] += "warm_up_mm = 0.6\nwarm_up_s = 0.4\n";
  const Scan cold = captured("cold", {});
  CaptureOptions patient;
  patient.drift_limit_mm = 0.01;
  patient.drift_interval_s = 0.0;
  const Scan waited = captured("waited", patient);
  ASSERT_TRUE(report_.drift_mm.has_value());
  EXPECT_LT(*report_.drift_mm, 0.01);
  EXPECT_LT(difference(waited, warm), 0.2 * difference(cold, warm));
}

TEST_F(WaitForDrift, GivesUpWithASentenceThatNamesTheMotion) {
  devices_["camera"] += "warm_up_mm = 3\nwarm_up_s = 2\n";
  CaptureOptions impatient;
  impatient.drift_limit_mm = 1e-6;
  impatient.drift_interval_s = 0.0;
  impatient.drift_patience_s = 0.0;
  try {
    static_cast<void>(captured("scan", impatient));
    FAIL() << "captured";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Device);
    EXPECT_NE(std::string(error.what()).find("still move by"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace frangia
