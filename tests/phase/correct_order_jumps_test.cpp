#include "frangia/phase/temporal/correct_order_jumps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/rig/projector.h"

namespace frangia {
namespace {

constexpr int kDiskWidth = 120;
constexpr int kDiskHeight = 90;
constexpr double kDiskNoise_rad = 0.02;
/// One fringe of the finest pattern, as the map of 8 fringes shows it.
constexpr double kOneFringe_rad = kTwoPi / 8.0;

/// A projector of 1280 columns: one fringe of the coarsest map.
Projector disk_display() {
  Projector projector;
  projector.model = CameraModel{.width_px = 1280, .height_px = 4, .focal_px = {800.0, 800.0}};
  return projector;
}

/// Phase of the finest of 1, 8 and 64 fringes.
using PhaseOf = std::function<double(int x, int y)>;

double disk_plane(int x, int y) {
  return 30.0 + 0.4 * x + 0.1 * y;
}

/// A disk in the middle, from 0 at its rim to 1 at half its radius.
double disk(int x, int y, double radius) {
  const double r = std::hypot(x - kDiskWidth / 2, y - kDiskHeight / 2) / radius;
  return std::clamp(2.0 - 2.0 * r, 0.0, 1.0);
}

/// Maps of a surface; indirect light adds `shift` to the map of 8 fringes.
std::vector<WrappedPhase> jump_maps(const PhaseOf& finest, const PhaseOf& shift) {
  std::vector<WrappedPhase> maps;
  for (const double count : {1.0, 8.0, 64.0}) {
    WrappedPhase map;
    map.pattern.period_px = 1280.0 / count;
    map.phase_rad = Image<float>(kDiskWidth, kDiskHeight, kMissing);
    map.sigma_rad = Image<float>(kDiskWidth, kDiskHeight, static_cast<float>(kDiskNoise_rad));
    map.status = Image<PixelStatus>(kDiskWidth, kDiskHeight, PixelStatus::Measured);
    for (int y = 0; y < kDiskHeight; ++y) {
      for (int x = 0; x < kDiskWidth; ++x) {
        const int index = y * kDiskWidth + x;
        const auto pixel = static_cast<std::uint64_t>(index);
        const double noise =
            kDiskNoise_rad * normal_from(hash(static_cast<std::uint64_t>(count), pixel));
        const double own = count == 8.0 ? shift(x, y) : 0.0;
        map.phase_rad(x, y) =
            static_cast<float>(wrap_rad(finest(x, y) * count / 64.0 + own + noise));
      }
    }
    maps.push_back(std::move(map));
  }
  return maps;
}

CoarsePhases coarse_phases_of(const std::vector<WrappedPhase>& maps) {
  return [&maps](std::span<const std::uint32_t> pixels) {
    std::vector<WrappedPhase> out;
    for (std::size_t m = 0; m + 1 < maps.size(); ++m) {
      WrappedPhase some;
      some.pattern = maps[m].pattern;
      some.phase_rad = Image<float>(static_cast<int>(pixels.size()), 1);
      some.sigma_rad = Image<float>(static_cast<int>(pixels.size()), 1);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        some.phase_rad.pixels()[i] = maps[m].phase_rad.pixels()[pixels[i]];
        some.sigma_rad.pixels()[i] = maps[m].sigma_rad.pixels()[pixels[i]];
      }
      out.push_back(std::move(some));
    }
    return out;
  };
}

/// Number of measured pixels whose order is not that of the surface.
int wrong_orders(const AbsolutePhase& phase, const PhaseOf& finest) {
  int wrong = 0;
  for (int y = 0; y < kDiskHeight; ++y) {
    for (int x = 0; x < kDiskWidth; ++x)
      wrong += std::abs(static_cast<double>(phase.phase_rad(x, y)) - finest(x, y)) > kPi ? 1 : 0;
  }
  return wrong;
}

double no_disk_shift(int /*x*/, int /*y*/) {
  return 0.0;
}

TEST(CorrectOrderJumps, CorrectsAnIslandThatIndirectLightShiftedByOneFringe) {
  const auto shift = [](int x, int y) { return kOneFringe_rad * disk(x, y, 30.0); };
  const auto maps = jump_maps(disk_plane, shift);
  AbsolutePhase phase = unwrap_temporally(maps, disk_display());
  const int before = wrong_orders(phase, disk_plane);
  ASSERT_GT(before, 800);  // three quarters of the disk's radius: 1590 pixels
  OrderJumpOptions options;
  options.max_share = 0.25;
  const OrderJumpResult found = correct_order_jumps(coarse_phases_of(maps), phase, options);
  EXPECT_LT(wrong_orders(phase, disk_plane), before / 100);
  EXPECT_NEAR(static_cast<double>(found.corrected), before, 0.02 * before);
  EXPECT_EQ(found.discarded, 0U);
}

TEST(CorrectOrderJumps, LeavesARealStepThatIsOneFringeHigh) {
  const auto block = [](int x, int y) {
    const bool on = x > 40 && x < 80 && y > 30 && y < 60;
    return disk_plane(x, y) + (on ? kTwoPi : 0.0);
  };
  const auto maps = jump_maps(block, no_disk_shift);
  AbsolutePhase phase = unwrap_temporally(maps, disk_display());
  const Image<float> before = phase.phase_rad;
  const OrderJumpResult found = correct_order_jumps(coarse_phases_of(maps), phase);
  EXPECT_EQ(found.corrected + found.discarded, 0U);
  EXPECT_EQ(phase.phase_rad.pixels()[5000], before.pixels()[5000]);
  EXPECT_EQ(wrong_orders(phase, block), 0);
}

TEST(CorrectOrderJumps, DiscardsARegionOfWhichEitherSideMayBeWrong) {
  const auto shift = [](int x, int y) {
    return kOneFringe_rad * std::clamp((x - 0.55 * kDiskWidth) / 10.0 + 0.5, 0.0, 1.0) + 0.0 * y;
  };
  const auto maps = jump_maps(disk_plane, shift);
  AbsolutePhase phase = unwrap_temporally(maps, disk_display());
  ASSERT_GT(wrong_orders(phase, disk_plane), 4000);
  AbsolutePhase unchanged = phase;
  const OrderJumpResult none = correct_order_jumps(coarse_phases_of(maps), unchanged);
  EXPECT_EQ(none.corrected + none.discarded, 0U);  // more than frames in order would have
  OrderJumpOptions options;
  options.max_share = 0.5;
  const OrderJumpResult found = correct_order_jumps(coarse_phases_of(maps), phase, options);
  EXPECT_GT(found.discarded, 4000U);
  EXPECT_EQ(found.corrected, 0U);
  EXPECT_LT(wrong_orders(phase, disk_plane), 50);
  EXPECT_EQ(phase.status(kDiskWidth - 2, 5), PixelStatus::UncertainOrder);
  EXPECT_TRUE(std::isnan(phase.sigma_rad(kDiskWidth - 2, 5)));
}

TEST(CorrectOrderJumps, AsksForNoCoarsePhaseWhereNothingJumps) {
  const auto maps = jump_maps(disk_plane, no_disk_shift);
  AbsolutePhase phase = unwrap_temporally(maps, disk_display());
  const auto unexpected = [](std::span<const std::uint32_t>) -> std::vector<WrappedPhase> {
    ADD_FAILURE() << "coarse phases were computed";
    return {};
  };
  EXPECT_EQ(correct_order_jumps(unexpected, phase).corrected, 0U);
}

}  // namespace
}  // namespace frangia
