#include "frangia/phase/wrap/merge_exposures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/random.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::tilted_plane;

constexpr int kSide = 200;
const NoiseModel kCamera = NoiseModel::from_camera(40.0, 30.0);

/// Four 8-bit frames per exposure; `light` is the mean in counts at the first exposure.
std::vector<FrameStack> taken(double light, const std::vector<double>& exposures_ms) {
  std::vector<FrameStack> stacks;
  Pattern pattern = testing::quarter_steps();
  pattern.exposures_ms = exposures_ms;
  for (std::size_t e = 0; e < exposures_ms.size(); ++e) {
    FrameStack stack{.pattern = pattern, .exposure = static_cast<int>(e)};
    for (std::size_t k = 0; k < 4; ++k) {
      Image<std::uint8_t> image(kSide, kSide);
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const double counts = stack.gain() * light *
                                (1.0 + 0.8 * std::cos(tilted_plane(x, y) + pattern.shifts_rad[k]));
          const auto place =
              hash(hash(10 * e + k, static_cast<std::uint64_t>(y)), static_cast<std::uint64_t>(x));
          const double sigma = std::sqrt(kCamera.variance(counts) - 1.0 / 12.0);
          image(x, y) = static_cast<std::uint8_t>(
              std::lround(std::clamp(counts + sigma * normal_from(place), 0.0, 255.0)));
        }
      }
      stack.frames.emplace_back(std::move(image));
    }
    stacks.push_back(std::move(stack));
  }
  return stacks;
}

struct Quality {
  double rms_rad = 0.0;
  double sigma_rad = 0.0;  ///< rms of the reported values
  double measured = 0.0;   ///< fraction of all pixels
};

Quality quality_of(const WrappedPhase& map) {
  Quality out;
  double count = 0.0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (map.status(x, y) != PixelStatus::Measured) continue;
      count += 1.0;
      out.rms_rad += std::pow(wrap_rad(map.phase_rad(x, y) - tilted_plane(x, y)), 2);
      out.sigma_rad += std::pow(static_cast<double>(map.sigma_rad(x, y)), 2);
    }
  }
  out.rms_rad = std::sqrt(out.rms_rad / count);
  out.sigma_rad = std::sqrt(out.sigma_rad / count);
  out.measured = count / (kSide * kSide);
  return out;
}

/// Cramér-Rao bound of the phase, from the exposures that do not saturate.
double bound_rad(double light, const std::vector<double>& gains) {
  double square = 0.0;
  for (int i = 0; i < 360; ++i) {
    double information =
        0.0;  // of the phase; mean and modulation are uncorrelated with it over four equal steps
    for (const double gain : gains) {
      for (int k = 0; k < 4; ++k) {
        const double angle = rad_from_deg(i) + 0.5 * kPi * k;
        const double counts = gain * light * (1.0 + 0.8 * std::cos(angle));
        information += std::pow(gain * light * 0.8 * std::sin(angle), 2) / kCamera.variance(counts);
      }
    }
    square += 1.0 / information / 360.0;
  }
  return std::sqrt(square);
}

TEST(MergeExposures, RecoversABrightPartAtTheCramerRaoBound) {
  // At four times 100 counts every frame saturates; only the first exposure remains.
  const auto stacks = taken(100.0, {1.0, 40.0});
  const Quality found = quality_of(merge_exposures(stacks, stacks[0].pattern.shifts_rad, kCamera));
  EXPECT_GT(found.measured, 0.999);
  EXPECT_NEAR(found.rms_rad / bound_rad(100.0, {1.0}), 1.0, 0.05);
  EXPECT_NEAR(found.rms_rad / found.sigma_rad, 1.0, 0.05);
}

TEST(MergeExposures, UsesAllExposuresOfADarkPartUpToTheBound) {
  const auto stacks = taken(10.0, {1.0, 2.0, 8.0});
  const Quality found = quality_of(
      merge_exposures(stacks, stacks[0].pattern.shifts_rad, kCamera, {.max_sigma_rad = 1.0F}));
  EXPECT_NEAR(found.rms_rad / bound_rad(10.0, {1.0, 2.0, 8.0}), 1.0, 0.05);
  EXPECT_NEAR(found.rms_rad / found.sigma_rad, 1.0, 0.05);
}

TEST(MergeExposures, UsesTheUnsaturatedSamplesOfAPartlySaturatedPixel) {
  const auto stacks = taken(70.0, {1.0, 2.5});  // the maxima of the long exposure saturate
  const Quality found = quality_of(merge_exposures(stacks, stacks[0].pattern.shifts_rad, kCamera));
  EXPECT_GT(found.measured, 0.999);
  EXPECT_LT(found.rms_rad, bound_rad(70.0, {1.0}));
  EXPECT_NEAR(found.rms_rad / found.sigma_rad, 1.0, 0.1);
}

TEST(MergeExposures, IsSaturatedWhereNoExposureIsShortEnough) {
  const auto stacks = taken(9000.0, {1.0, 2.0});
  const WrappedPhase map = merge_exposures(stacks, stacks[0].pattern.shifts_rad, kCamera);
  EXPECT_EQ(map.status(50, 50), PixelStatus::Saturated);
  EXPECT_TRUE(std::isnan(map.phase_rad(50, 50)));
}

TEST(MergeExposures, RefusesStacksOfDifferentSize) {
  auto stacks = taken(50.0, {1.0, 2.0});
  const auto shifts = stacks[0].pattern.shifts_rad;
  stacks[1].frames.pop_back();
  EXPECT_THROW(static_cast<void>(merge_exposures(stacks, shifts, kCamera)), Error);
  EXPECT_THROW(static_cast<void>(merge_exposures({}, shifts, kCamera)), Error);
}

}  // namespace
}  // namespace frangia
