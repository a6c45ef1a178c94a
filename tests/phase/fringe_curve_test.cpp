#include "frangia/phase/internal/fringe_curve.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

struct FringeMaps {
  std::vector<double> per_unit;
  double first;
  double last;

  [[nodiscard]] std::vector<float> phases_at(double place) const {
    std::vector<float> phases;
    for (const double frequency : per_unit)
      phases.push_back(static_cast<float>(wrap_rad(kTwoPi * frequency * place)));
    return phases;
  }
  /// By trying every place of the field and a little beyond; places there cost their distance.
  [[nodiscard]] double nearest_distance(const std::vector<float>& phases) const {
    constexpr int kSteps = 200'000;
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i <= kSteps; ++i) {
      const double place = first + (last - first) * i / kSteps;
      double square = 0.0;
      for (std::size_t m = 0; m < phases.size(); ++m)
        square += std::pow(wrap_rad(phases[m] - kTwoPi * per_unit[m] * place), 2);
      least = std::min(least, square);
    }
    return std::sqrt(least);
  }
};

TEST(FringeCurve, FindsThePlaceOfExactPhases) {
  for (const FringeMaps& maps :
       {FringeMaps{{0.01, 0.08, 0.64}, -0.5, 99.5}, FringeMaps{{0.53, 0.64, 0.58}, -3.0, 6.0}}) {
    FringeCurve curve(maps.per_unit, maps.first, maps.last);
    for (int i = 0; i <= 40; ++i) {
      const double place = maps.first + (maps.last - maps.first) * (0.01 + 0.98 * i / 40.0);
      const FringeCurve::Nearest found = curve.nearest(maps.phases_at(place));
      EXPECT_NEAR(static_cast<double>(found.unit), place, 1e-3);
      EXPECT_NEAR(found.distance_rad, 0.0F, 1e-3F);
    }
  }
}

TEST(FringeCurve, FindsTheNearestPlaceOfPhasesThatDoNotBelongTogether) {
  const FringeMaps maps{{0.01, 0.05, 0.13}, 0.0, 100.0};
  FringeCurve curve(maps.per_unit, maps.first, maps.last);
  for (std::uint64_t i = 0; i < 20; ++i) {
    std::vector<float> phases;
    for (std::uint64_t m = 0; m < 3; ++m)
      phases.push_back(static_cast<float>(kTwoPi * uniform_from(hash(i, m)) - kPi));
    const FringeCurve::Nearest found = curve.nearest(phases);
    const double wanted = maps.nearest_distance(phases);
    EXPECT_LE(found.distance_rad, wanted + 1e-3) << i;
    if (found.unit > 0.0F && found.unit < 100.0F) {
      EXPECT_NEAR(found.distance_rad, wanted, 1e-3) << i;
    }
  }
}

TEST(FringeCurve, CountsTheDistanceFromTheField) {
  // One map: each phase is exact somewhere, at the cost of the distance from the field.
  FringeCurve curve({0.1}, 0.0, 4.0);  // 0.4 of a fringe
  EXPECT_NEAR(curve.nearest(std::vector<float>{1.0F}).distance_rad, 0.0F, 1e-5F);
  EXPECT_NEAR(curve.nearest(std::vector<float>{-0.3F}).distance_rad, 0.3F, 1e-5F);
  EXPECT_NEAR(curve.nearest(std::vector<float>{2.8F}).distance_rad, 2.8F - 0.8F * kPiF, 1e-5F);
}

}  // namespace
}  // namespace frangia
