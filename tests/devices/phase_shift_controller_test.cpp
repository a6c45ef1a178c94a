#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/devices/phase_shifter.h"

namespace frangia {
namespace {

/// Records its commands.
class WritingShifter final : public PhaseShifter {
 public:
  WritingShifter() {
    info_.max_command = 12.0;
    info_.curve = {{0.0, 12.0}, {0.0, 1.2 * kTwoPi}};  // 10 V per turn
  }
  [[nodiscard]] std::string name() const override { return "writing shifter"; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override { return "works"; }
  void make_safe() noexcept override {}
  [[nodiscard]] const ShifterInfo& info() const override { return info_; }
  void drive(double command, const Deadline& /*deadline*/) override { driven.push_back(command); }

  std::vector<double> driven;

 private:
  ShifterInfo info_;
};

void expect_near(const std::vector<double>& found, const std::vector<double>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], wanted[i], 1e-9);
}

TEST(PhaseShiftController, ApproachesEveryShiftFromBelow) {
  WritingShifter shifter;
  PhaseShiftController driver(shifter);
  for (const double turns : {0.25, 0.5, 0.25})
    driver.shift_to(turns * kTwoPi, Deadline::in(1.0));
  expect_near(shifter.driven, {0.0, 2.5, 5.0, 0.0, 2.5});
}

TEST(PhaseShiftController, ScalesShiftsByTheCorrection) {
  WritingShifter shifter;
  PhaseShiftController driver(shifter);
  driver.set_scale(1.0 / 1.05);
  driver.shift_to(0.5 * kTwoPi, Deadline::in(1.0));
  expect_near(shifter.driven, {0.0, 5.0 / 1.05});
}

TEST(PhaseShiftController, ReducesAShiftBeyondTheRangeByAWholeTurn) {
  WritingShifter shifter;
  PhaseShiftController driver(shifter);
  driver.shift_to(0.9 * kTwoPi, Deadline::in(1.0));
  driver.shift_to(1.5 * kTwoPi, Deadline::in(1.0));
  expect_near(shifter.driven, {0.0, 9.0, 0.0, 5.0});
}

}  // namespace
}  // namespace frangia
