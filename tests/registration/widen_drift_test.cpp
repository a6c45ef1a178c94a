#include <gtest/gtest.h>

#include "frangia/registration/internal/drift_views.h"

namespace frangia {
namespace {

/// Two lenses of one parameter each, in units of their standard deviations.
DriftHypotheses two_lenses() {
  return {{{0}, {1}}, 2, [](const Eigen::VectorXd& widening) -> Eigen::MatrixXd {
            return widening.asDiagonal();
          }};
}

/// Surfaces that measure one combination of the two to a hundredth of its standard deviation.
DriftEvidence measured(const Eigen::Vector2d& row, double value, const Eigen::Vector2d& about) {
  constexpr double kInformation = 1e4;
  return {kInformation * row * row.transpose(), kInformation * row * (row.dot(about) - value)};
}

TEST(WidenDrift, WidensTheLensThatIsFartherOffAndNotTheOther) {
  const Eigen::Vector2d about(3.0, 0.5);
  const auto widening =
      widening_by_evidence(two_lenses(), measured({1.0, 0.0}, 20.0, about), about);
  EXPECT_GT(widening[0], 7.0);
  EXPECT_LT(widening[1], 2.0);
}

TEST(WidenDrift, WidensBothLensesWhereEitherExplainsTheSurfaces) {
  const Eigen::Vector2d about(0.0, 0.0);
  const auto widening =
      widening_by_evidence(two_lenses(), measured({1.0, -1.0}, 20.0, about), about);
  EXPECT_GT(widening[0], 5.0);
  EXPECT_NEAR(widening[0], widening[1], 1e-6);
}

TEST(WidenDrift, KeepsTheStandardDeviationsOfADriftThatTheyAllow) {
  const Eigen::Vector2d about(0.2, 0.0);
  const auto widening = widening_by_evidence(two_lenses(), measured({1.0, 0.0}, 1.0, about), about);
  EXPECT_LT(widening.maxCoeff(), 1.3);
}

TEST(WidenDrift, GainsWhatTheWiderLensExplains) {
  // 17 standard deviations of a measurement to a hundredth of one, of which a lens 20 times as wide
  // leaves hardly any.
  const Eigen::Vector2d about(3.0, 0.0);
  const Eigen::Vector2d there(20.0, 0.0);
  const Eigen::Vector2d wide(20.0, 1.0);
  const DriftEvidence evidence = measured({1.0, 0.0}, 20.0, about);
  EXPECT_NEAR(gain_by_widening(two_lenses(), evidence, about, wide), 1e4 * 17.0 * 17.0, 1.0);
  EXPECT_NEAR(
      gain_by_widening(two_lenses(), measured({1.0, 0.0}, 20.0, there), there, wide), 0.0, 1.0);
}

}  // namespace
}  // namespace frangia
