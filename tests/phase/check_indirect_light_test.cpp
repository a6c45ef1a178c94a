#include "frangia/phase/temporal/check_indirect_light.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

constexpr int kPlaneWidth = 80;
constexpr int kPlaneHeight = 60;
constexpr float kPlaneNoise_rad = 0.01F;

/// Maps of 1, 8 and 64 fringes of an inclined plane with a step in the middle, and their finest
/// absolute phase. On the left, indirect light shifts the map of 8 fringes.
struct Maps {
  std::vector<WrappedPhase> wrapped;
  AbsolutePhase absolute;
};

Maps maps_with(double shift_rad) {
  Maps out;
  const std::vector<double> counts = {1.0, 8.0, 64.0};
  for (std::size_t m = 0; m < counts.size(); ++m) {
    WrappedPhase map;
    map.pattern.name = "f" + std::to_string(static_cast<int>(counts[m]));
    map.pattern.period_px = 1280.0 / counts[m];
    map.phase_rad = Image<float>(kPlaneWidth, kPlaneHeight, kMissing);
    map.sigma_rad = Image<float>(kPlaneWidth, kPlaneHeight, kPlaneNoise_rad);
    map.modulation_counts = Image<float>(kPlaneWidth, kPlaneHeight, m == 2 ? 40.0F : 50.0F);
    map.mean_counts = Image<float>(kPlaneWidth, kPlaneHeight, 60.0F);
    map.status = Image<PixelStatus>(kPlaneWidth, kPlaneHeight, PixelStatus::Measured);
    if (m == 2) {
      out.absolute.pattern = map.pattern;
      out.absolute.phase_rad = map.phase_rad;
      out.absolute.sigma_rad = map.sigma_rad;
      out.absolute.status = map.status;
    }
    for (int y = 0; y < kPlaneHeight; ++y) {
      for (int x = 0; x < kPlaneWidth; ++x) {
        const double finest = 20.0 + 0.4 * x + 0.1 * y + (x > kPlaneWidth / 2 ? 9.0 : 0.0);
        const auto pixel = static_cast<std::uint64_t>(y * kPlaneWidth + x);
        double phase = finest * counts[m] / 64.0 +
                       static_cast<double>(kPlaneNoise_rad) * normal_from(hash(m + 1, pixel));
        if (m == 2) out.absolute.phase_rad(x, y) = static_cast<float>(phase);
        if (m == 1 && x < 20) phase += shift_rad;
        map.phase_rad(x, y) = static_cast<float>(wrap_rad(phase));
      }
    }
    out.wrapped.push_back(map);
  }
  return out;
}

TEST(CheckIndirectLight, CountsADisagreementWhereItIs) {
  Maps maps = maps_with(0.08);
  const IndirectLightCheck check = check_indirect_light(maps.wrapped, maps.absolute);
  EXPECT_TRUE(check.found);
  EXPECT_EQ(check.pattern, "f8");
  EXPECT_NEAR(check.disagreement_rad, 0.08, 0.01);
  EXPECT_NEAR(check.affected, 0.24, 0.05);
  EXPECT_NEAR(check.modulation_ratio, 0.8, 1e-6);
  ASSERT_FALSE(maps.absolute.systematic_rad.empty());
  EXPECT_NEAR(maps.absolute.systematic_rad(10, 30), 0.08 / std::sqrt(8.0), 0.005);
  EXPECT_EQ(maps.absolute.systematic_rad(60, 30), 0.0F);
  EXPECT_NE(describe(check).find("a plan for indirect light"), std::string::npos);
}

TEST(CheckIndirectLight, FindsNothingInNoiseAndAtSteps) {
  Maps maps = maps_with(0.0);
  EXPECT_FALSE(check_indirect_light(maps.wrapped, maps.absolute).found);
  EXPECT_TRUE(maps.absolute.systematic_rad.empty());
  EXPECT_FALSE(check_indirect_light(std::span(maps.wrapped).subspan(2), maps.absolute).found);
}

TEST(CheckIndirectLight, LeavesWhatHarmonicsExplainToThem) {
  Maps maps = maps_with(0.08);
  maps.wrapped[1].systematic_rad = Image<float>(kPlaneWidth, kPlaneHeight, 0.08F);
  EXPECT_FALSE(check_indirect_light(maps.wrapped, maps.absolute).found);
}

}  // namespace
}  // namespace frangia
