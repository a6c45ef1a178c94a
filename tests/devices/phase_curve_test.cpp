#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/devices/phase_shifter.h"

#include "support/linspace.h"

namespace frangia {
namespace {

TEST(PhaseCurve, InvertsThePhaseToItsCommand) {
  const PhaseCurve rising{{0.0, 2.0, 10.0}, {0.1, 3.0, 8.0}};
  const PhaseCurve falling{{0.0, 2.0, 10.0}, {0.1, -3.0, -8.0}};
  for (const double command : testing::linspace(21, 0.0, 10.0)) {
    // The phase may differ by whole turns where the curve spans more than a turn.
    for (const PhaseCurve& curve : {rising, falling}) {
      const double phase = curve.phase_at(command);
      EXPECT_NEAR(wrap_rad(curve.phase_at(curve.command_for(phase)) - phase), 0.0, 1e-12);
      EXPECT_NEAR(curve.command_for(phase), command, 1e-9);
    }
  }
}

TEST(PhaseCurve, ShiftsAPhaseBeyondItsEndsByWholeTurns) {
  const PhaseCurve curve{{0.0, 10.0}, {0.0, 1.2 * kTwoPi}};
  EXPECT_NEAR(curve.command_for(2.5 * kTwoPi), 10.0 * 0.5 / 1.2, 1e-9);
  EXPECT_NEAR(curve.command_for(-0.25 * kTwoPi), 10.0 * 0.75 / 1.2, 1e-9);
}

TEST(PhaseCurve, RefusesAPhaseOutsideItsRange) {
  const PhaseCurve half{{0.0, 5.0}, {0.0, 0.5 * kTwoPi}};
  EXPECT_THROW(static_cast<void>(half.command_for(0.75 * kTwoPi)), Error);
}

TEST(PhaseCurve, NeedsRisingCommandsAndMonotonicPhases) {
  EXPECT_THROW((PhaseCurve{{0.0, 0.0}, {0.0, 1.0}}.check("rig.toml")), Error);
  EXPECT_THROW((PhaseCurve{{0.0, 1.0, 2.0}, {0.0, 1.0, 0.5}}.check("rig.toml")), Error);
  EXPECT_THROW((PhaseCurve{{0.0, 1.0}, {0.0}}.check("rig.toml")), Error);
  EXPECT_NO_THROW((PhaseCurve{{0.0, 1.0}, {1.0, 0.0}}.check("rig.toml")));
}

}  // namespace
}  // namespace frangia
