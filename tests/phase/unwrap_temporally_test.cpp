#include "frangia/phase/temporal/unwrap_temporally.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/algorithm/published_algorithms.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;
using testing::render_frames;
using testing::Scene;

/// A projector of 640 columns that illuminates a wall, one column per camera column.
Projector wall_display() {
  Projector projector;
  projector.model = CameraModel{.width_px = 640, .height_px = 4, .focal_px = {800.0, 800.0}};
  return projector;
}

Pattern columns(double period_px) {
  return {.name = "p", .period_px = period_px, .shifts_rad = equal_shifts(4, 0.5 * kPi)};
}

WrappedPhase level(const Scene& scene, double period_px) {
  const auto stack =
      render_frames(scene, columns(period_px), [&](int x, int) { return kTwoPi * x / period_px; });
  return wrap_phase(stack,
                    make_algorithm(default_algorithm(stack.pattern), stack.pattern.shifts_rad),
                    {.floor_counts2 = scene.noise_counts * scene.noise_counts + 1.0},
                    {.max_sigma_rad = 0.5F});
}

std::vector<WrappedPhase> levels(const Scene& scene, const std::vector<double>& periods) {
  std::vector<WrappedPhase> out;
  out.reserve(periods.size());
  for (const double period : periods)
    out.push_back(level(scene, period));
  return out;
}

TEST(UnwrapTemporally, RecoversTheColumnOverTheWholeField) {
  const Scene scene;
  const AbsolutePhase phase = unwrap_temporally(levels(scene, {640.0, 80.0, 10.0}), wall_display());
  for (int x = 1; x < scene.width - 1; ++x)
    EXPECT_NEAR(phase.phase_rad(x, 1) * 10.0 / kTwoPi, x, 1e-3);
}

TEST(UnwrapTemporally, LeavesUncertainOrdersMissingAndReportsThem) {
  const Scene noisy{.noise_counts = 3000.0};
  const AbsolutePhase phase =
      unwrap_temporally(levels(noisy, {640.0, 10.0}), wall_display(), {.smooth_radius_px = 0});
  for (std::size_t i = 0; i < phase.status.pixels().size(); ++i) {
    EXPECT_TRUE(std::isnan(phase.phase_rad.pixels()[i]));
    EXPECT_EQ(phase.status.pixels()[i], PixelStatus::UncertainOrder);
  }
}

TEST(UnwrapTemporally, WrongOrdersStayWithinTheAllowedProbability) {
  // Sigma 0.093 rad and ratio 8 give a probability of a wrong order of about 2.6e-5 per pixel.
  const Scene noisy{.height = 2000, .noise_counts = 2630.0, .seed = 11};
  const AbsolutePhase phase = unwrap_temporally(levels(noisy, {640.0, 80.0}),
                                                wall_display(),
                                                {.max_wrong_order = 1e-3, .smooth_radius_px = 0});
  int wrong = 0;
  int kept = 0;
  for (int y = 0; y < noisy.height; ++y) {
    for (int x = 0; x < noisy.width; ++x) {
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      ++kept;
      wrong += std::abs(phase.phase_rad(x, y) - kTwoPi * x / 80.0) > kPi ? 1 : 0;
    }
  }
  EXPECT_GT(kept, 1'100'000);
  EXPECT_LT(wrong, 1e-3 * kept);
}

TEST(UnwrapTemporally, SmoothingTheCoarsePhaseKeepsMorePixelsAndLeavesTheFinePhaseUnchanged) {
  const Scene noisy{.height = 60, .noise_counts = 1200.0, .seed = 5};
  const auto both = levels(noisy, {640.0, 20.0});
  const AbsolutePhase rough = unwrap_temporally(both, wall_display(), {.smooth_radius_px = 0});
  const AbsolutePhase smooth = unwrap_temporally(both, wall_display());
  int saved = 0;
  for (std::size_t i = 0; i < smooth.status.pixels().size(); ++i) {
    const double fine = both[1].phase_rad.pixels()[i];
    if (smooth.status.pixels()[i] != PixelStatus::Measured) continue;
    saved += rough.status.pixels()[i] == PixelStatus::UncertainOrder ? 1 : 0;
    EXPECT_NEAR(wrap_rad(smooth.phase_rad.pixels()[i] - fine), 0.0, 1e-4);
  }
  EXPECT_GT(saved, 30000);
}

TEST(UnwrapTemporally, WrongOrderProbabilityMatchesTheFormula) {
  // A probability below 1e-6 needs sigma < 0.287 rad for ratio 2 and < 0.080 rad for ratio 8.
  EXPECT_NEAR(wrong_order_probability(0.287 * std::sqrt(5.0)), 1e-6, 0.1e-6);
  EXPECT_NEAR(wrong_order_probability(0.0797 * std::sqrt(65.0)), 1e-6, 0.1e-6);
}

TEST(UnwrapTemporally, MarksTheEndsOfTheFieldUncertainWhereNoiseWrapsThePhase) {
  const Scene noisy{.height = 50, .noise_counts = 2000.0};
  const AbsolutePhase phase = unwrap_temporally(levels(noisy, {640.0}), wall_display());
  for (int y = 0; y < noisy.height; ++y) {
    EXPECT_EQ(phase.status(0, y), PixelStatus::UncertainOrder);
    for (int x = 0; x < noisy.width; ++x) {
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      EXPECT_NEAR(phase.phase_rad(x, y), kTwoPi * x / 640.0, kPi);
    }
  }
}

TEST(UnwrapTemporally, RefusesLevelsOutOfOrderOrWithoutAnAbsoluteStart) {
  const Scene scene;
  EXPECT_THROW(
      static_cast<void>(unwrap_temporally(levels(scene, {640.0, 10.0, 80.0}), wall_display())),
      Error);
  EXPECT_THROW(static_cast<void>(unwrap_temporally(levels(scene, {320.0, 10.0}), wall_display())),
               Error);
  EXPECT_THROW(static_cast<void>(unwrap_temporally({}, wall_display())), Error);
}

TEST(UnwrapTemporally, InPlaceGivesTheSamePhase) {
  const std::vector<WrappedPhase> maps = levels({.noise_counts = 500.0}, {640.0, 80.0, 10.0});
  const AbsolutePhase copied = unwrap_temporally(maps, wall_display());
  const AbsolutePhase moved =
      unwrap_temporally_in_place(std::vector<WrappedPhase>(maps), wall_display());
  ASSERT_TRUE(same_size(moved.phase_rad, copied.phase_rad));
  for (std::size_t i = 0; i < copied.status.pixels().size(); ++i) {
    ASSERT_EQ(moved.status.pixels()[i], copied.status.pixels()[i]) << i;
    if (copied.status.pixels()[i] != PixelStatus::Measured) continue;
    ASSERT_EQ(moved.phase_rad.pixels()[i], copied.phase_rad.pixels()[i]) << i;
    ASSERT_EQ(moved.sigma_rad.pixels()[i], copied.sigma_rad.pixels()[i]) << i;
  }
}

}  // namespace
}  // namespace frangia
