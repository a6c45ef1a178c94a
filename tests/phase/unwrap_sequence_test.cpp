#include "frangia/phase/temporal/unwrap_sequence.h"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/pattern/fringe_sequence.h"

namespace frangia {
namespace {

constexpr int kMapWidth = 640;
constexpr int kMapHeight = 300;
constexpr int kMargin = 110;  ///< columns at both ends of the field, where noise can wrap the phase

Projector wide_display() {
  Projector projector;
  projector.model = CameraModel{.width_px = kMapWidth, .height_px = 4, .focal_px = {800.0, 800.0}};
  return projector;
}

/// A wrapped map of `fringes` over the columns, with noise.
WrappedPhase map_of(double fringes, double sigma, std::uint64_t seed) {
  WrappedPhase map{.pattern = {.name = "p", .period_px = kMapWidth / fringes},
                   .phase_rad = Image<float>(kMapWidth, kMapHeight),
                   .sigma_rad = Image<float>(kMapWidth, kMapHeight, static_cast<float>(sigma)),
                   .status = Image<PixelStatus>(kMapWidth, kMapHeight, PixelStatus::Measured)};
  for (int y = 0; y < kMapHeight; ++y) {
    for (int x = 0; x < kMapWidth; ++x) {
      const auto place = static_cast<std::uint64_t>(y) * kMapWidth + static_cast<std::uint64_t>(x);
      const double noise = sigma * normal_from(hash(seed, place));
      map.phase_rad(x, y) = static_cast<float>(wrap_rad(kTwoPi * fringes * x / kMapWidth + noise));
    }
  }
  return map;
}

std::vector<WrappedPhase> maps_of(const std::vector<double>& sequence, double sigma) {
  std::vector<WrappedPhase> maps;
  maps.reserve(sequence.size());
  for (const double fringes : sequence)
    maps.push_back(map_of(fringes, sigma, maps.size() + 1));
  return maps;
}

std::optional<SequenceMethod> method_of(std::span<const WrappedPhase> maps) {
  std::vector<Pattern> patterns;
  for (const WrappedPhase& map : maps)
    patterns.push_back(map.pattern);
  return find_sequence_method(patterns, wide_display());
}

/// Unwraps by the method that the patterns allow.
AbsolutePhase unwrapped(std::span<const WrappedPhase> maps,
                        const TemporalUnwrapOptions& options = {}) {
  return unwrap_sequence(maps, wide_display(), method_of(maps).value(), options);
}

struct Errors {
  double rms_rad = 0.0;  ///< over pixels of the correct order
  double wrong_share = 0.0;
  double kept_share = 0.0;
};

Errors errors_of(const AbsolutePhase& phase, double fringes) {
  double square = 0.0;
  double right = 0.0;
  double wrong = 0.0;
  for (int y = 0; y < kMapHeight; ++y) {
    for (int x = kMargin; x < kMapWidth - kMargin; ++x) {
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      const double error = phase.phase_rad(x, y) - kTwoPi * fringes * x / kMapWidth;
      (std::abs(error) > kPi ? wrong : right) += 1.0;
      if (std::abs(error) <= kPi) square += error * error;
    }
  }
  const double all = (kMapWidth - 2.0 * kMargin) * kMapHeight;
  return {std::sqrt(square / right), wrong / (right + wrong), (right + wrong) / all};
}

TEST(UnwrapSequence, SlopeOfAllMapsReducesNoiseByThePublishedFactors) {
  const double sigma = 0.05;
  for (const auto& [name, factor] :
       {std::pair{"negative-exponential", 0.43}, std::pair{"doubling", 0.87}}) {
    const auto maps = maps_of(fringe_sequence(name, 64.0), sigma);
    const Errors errors = errors_of(unwrapped(maps), 64.0);
    EXPECT_NEAR(errors.rms_rad / sigma, factor, 0.01) << name;
    EXPECT_EQ(errors.wrong_share, 0.0) << name;
    EXPECT_GT(errors.kept_share, 0.999) << name;
  }
}

TEST(UnwrapSequence, PredictsTheSigmaOfTheSlope) {
  const AbsolutePhase phase =
      unwrapped(maps_of(fringe_sequence("negative-exponential", 64.0), 0.05));
  EXPECT_NEAR(phase.sigma_rad(300, 5), 0.4318 * 0.05, 1e-4);
}

TEST(UnwrapSequence, AcceptsHeterodyneAndNonIntegerRatios) {
  for (const auto& sequence :
       {fringe_sequence("heterodyne", 64.0), std::vector<double>{1.0, 3.7, 11.9, 40.3}}) {
    const Errors errors = errors_of(unwrapped(maps_of(sequence, 0.02)), sequence.back());
    EXPECT_EQ(errors.wrong_share, 0.0);
    EXPECT_GT(errors.kept_share, 0.99);
  }
}

TEST(UnwrapSequence, WrongOrdersOccurAsPredictedAndAreDiscardedAboveTheLimit) {
  // Two maps of ratio 8: at sigma 0.15 rad the order of erfc(pi / (0.15 sqrt 2 sqrt 65)) of all
  // pixels is wrong.
  const double sigma = 0.15;
  const auto maps = maps_of({1.0, 8.0}, sigma);
  const double expected = wrong_order_probability(sigma * std::sqrt(65.0));
  const Errors all = errors_of(unwrapped(maps, {.max_wrong_order = 1.0}), 8.0);
  const double deviation = std::sqrt(expected / ((kMapWidth - 2.0 * kMargin) * kMapHeight));
  EXPECT_NEAR(all.wrong_share, expected, 4.0 * deviation);
  const AbsolutePhase strict = unwrapped(maps, {.max_wrong_order = 0.5 * expected});
  EXPECT_EQ(strict.status(300, 5), PixelStatus::UncertainOrder);
}

TEST(UnwrapSequence, UnwrapsBeatsOfBeats) {
  // No map and no beat of two has one fringe: 6, 5, and 64 - 2 * 58 + 53 = 1.
  const std::vector<double> sequence{53.0, 58.0, 64.0};
  const double sigma = 0.05;
  const Errors errors = errors_of(unwrapped(maps_of(sequence, sigma)), 64.0);
  EXPECT_LT(errors.wrong_share, 1e-5);
  EXPECT_GT(errors.kept_share, 0.999);
  EXPECT_NEAR(errors.rms_rad / sigma, 1.0 / std::hypot(1.0, 58.0 / 64.0, 53.0 / 64.0), 0.01);
}

TEST(UnwrapSequence, UnwrapsANarrowBandWhoseBeatsAllExceedOneFringe) {
  const SequencePlan plan = plan_beats(47.0, 4, 40.0, 0.05);
  const Errors errors = errors_of(unwrapped(maps_of(plan.fringes, 0.05)), 47.0);
  EXPECT_LT(errors.wrong_share, 1e-5);
  EXPECT_GT(errors.kept_share, 0.999);
}

TEST(UnwrapSequence, UnwrapsByABeatThatIsSafeOnlyAtLowNoise) {
  const std::vector<double> sequence{15.0, 16.0};
  const std::vector<WrappedPhase> quiet = maps_of(sequence, 0.01);
  EXPECT_EQ(method_of(quiet), SequenceMethod::Levels);
  const Errors errors = errors_of(unwrapped(quiet), 16.0);
  EXPECT_EQ(errors.wrong_share, 0.0);
  EXPECT_GT(errors.kept_share, 0.999);
}

TEST(UnwrapSequence, ConfusesOrdersAsOftenAsPredicted) {
  const std::vector<double> sequence{53.0, 58.0, 64.0};
  const double sigma = 0.11;
  const double expected = confusion_probability(sequence, sigma);
  const Errors all = errors_of(unwrapped(maps_of(sequence, sigma), {.max_wrong_order = 1.0}), 64.0);
  EXPECT_GT(expected, 1e-3);
  EXPECT_NEAR(all.wrong_share / expected, 1.0, 0.25);
  // A limit discards the pixels whose second order is likely: few wrong orders are left.
  const Errors strict =
      errors_of(unwrapped(maps_of(sequence, sigma), {.max_wrong_order = 1e-4}), 64.0);
  EXPECT_LT(strict.wrong_share, 2e-4);
  EXPECT_GT(strict.kept_share, 0.5);
}

TEST(UnwrapSequence, DiscardsTheEndsOfAFieldWhereNoiseReachesTheOtherEnd) {
  const std::vector<double> sequence{53.0, 58.0, 64.0};
  const AbsolutePhase phase = unwrapped(maps_of(sequence, 0.05));
  for (int y = 0; y < kMapHeight; ++y) {
    for (const int x : {0, kMapWidth - 1}) {
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      EXPECT_NEAR(phase.phase_rad(x, y), kTwoPi * 64.0 * x / kMapWidth, 0.5);
    }
  }
}

TEST(UnwrapSequence, SearchesWhereNoLevelsAreSafe) {
  EXPECT_EQ(method_of(maps_of({1.0, 8.0, 64.0}, 0.05)), SequenceMethod::Levels);
  EXPECT_EQ(method_of(maps_of({53.0, 58.0, 64.0}, 0.05)), SequenceMethod::Search);
  EXPECT_EQ(method_of(maps_of({10.0, 20.0}, 0.05)), std::nullopt);
  EXPECT_EQ(method_of({}), std::nullopt);
}

TEST(UnwrapSequence, RefusesMapsThatDetermineNoAbsolutePhase) {
  const auto refuses = [](const std::vector<WrappedPhase>& maps) {
    for (const SequenceMethod method : {SequenceMethod::Levels, SequenceMethod::Search})
      EXPECT_THROW(static_cast<void>(unwrap_sequence(maps, wide_display(), method)), Error);
  };
  refuses({});
  refuses(maps_of({10.0, 20.0}, 0.01));
  refuses(maps_of({1.0, 8.0, 4.0, 0.5}, 0.01));
  auto broken = maps_of({1.0, 8.0}, 0.01);
  broken[1].pattern.period_px = std::nan("");
  refuses(broken);
}

}  // namespace
}  // namespace frangia
