#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/rig/fringe_waveform.h"

#include "support/linspace.h"

namespace frangia {
namespace {

/// Light of a display of gamma 2.2 with ambient light, at evenly spaced levels.
ResponseCurve gamma_curve(int levels) {
  std::vector<double> at;
  std::vector<double> light;
  for (int i = 0; i < levels; ++i) {
    at.push_back(static_cast<double>(i) / (levels - 1));
    light.push_back(12.0 + 150.0 * std::pow(at.back(), 2.2));
  }
  return make_response_curve(at, light);
}

TEST(ResponseCurve, ReproducesAGammaAndInvertsIt) {
  const ResponseCurve curve = gamma_curve(17);
  for (const double level : testing::linspace(91, 0.1, 1.0)) {
    EXPECT_NEAR(curve.light_of(level), std::pow(level, 2.2), 2e-3) << level;
    EXPECT_NEAR(curve.level_of(curve.light_of(level)), level, 1e-9);
  }
}

TEST(ResponseCurve, IsMonotoneForFallingMeasurements) {
  const ResponseCurve curve = make_response_curve({0.0, 0.2, 0.5, 0.7, 1.0}, {5, 9, 8, 20, 40});
  for (std::size_t i = 1; i < curve.light.size(); ++i)
    EXPECT_GE(curve.light[i], curve.light[i - 1]);
  EXPECT_EQ(curve.light.front(), 0.0);
  EXPECT_EQ(curve.light.back(), 1.0);
}

TEST(ResponseCurve, IsLinearThroughItsOwnLookUpTable) {
  const ResponseCurve curve = gamma_curve(17);
  const ResponseCurve line{{0.0, 1.0}};
  const ResponseCurve same = compose(curve, line);
  for (const double level : testing::linspace(21, 0.0, 1.0))
    EXPECT_NEAR(same.light_of(level), curve.light_of(level), 1e-3);
}

TEST(ResponseCurve, RefusesADarkProjectorAndLevelsOutOfOrder) {
  EXPECT_THROW(static_cast<void>(make_response_curve({0.0, 0.5, 1.0}, {5, 5, 5})), Error);
  EXPECT_THROW(static_cast<void>(make_response_curve({0.0, 0.5, 0.4}, {1, 2, 3})), Error);
  EXPECT_THROW(static_cast<void>(make_response_curve({0.0, 1.0}, {1, 2})), Error);
}

}  // namespace
}  // namespace frangia
