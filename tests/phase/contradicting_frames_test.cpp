#include "frangia/phase/waveform/contradicting_frames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;
using testing::render_frames;
using testing::tilted_plane;

const NoiseModel kCoveredNoise{.floor_counts2 = 200.0 * 200.0};

/// Fringes of which something else covers a square in some frames.
struct CoveredFringes {
  FrameStack stack;
  FittedAlgorithm fitted;
  WrappedPhase map;
  Image<float> unexplained_rad;

  static constexpr int kFrom = 60;
  static constexpr int kTo = 100;
  [[nodiscard]] static bool is_inside(int x, int y) {
    return x >= kFrom && x < kTo && y >= kFrom && y < kTo;
  }
  /// A pixel whose window is outside of the square.
  [[nodiscard]] static bool is_outside(int x, int y) {
    return x < kFrom - 3 || x >= kTo + 3 || y < kFrom - 3 || y >= kTo + 3;
  }

  CoveredFringes(int frames, const std::vector<std::size_t>& covered, double counts = 45000.0) {
    Pattern pattern{.name = "fringe", .period_px = 20.0};
    pattern.shifts_rad = equal_shifts(frames, kTwoPi / frames);
    stack = render_frames(
        {.width = 200, .height = 160, .modulation_counts = 9000.0, .noise_counts = 200.0},
        pattern,
        tilted_plane);
    fitted = fit_algorithm("auto", stack, kCoveredNoise);
    for (const std::size_t k : covered) {
      auto& image = std::get<Image<std::uint16_t>>(stack.frames[k]);
      for (int y = kFrom; y < kTo; ++y)
        for (int x = kFrom; x < kTo; ++x)
          image(x, y) = static_cast<std::uint16_t>(counts + 3.0 * ((7 * x + 13 * y) % 200));
    }
    map = wrap_phase(stack, fitted.algorithm, kCoveredNoise);
    unexplained_rad = unexplained_phase(stack, fitted, kCoveredNoise);
  }
};

TEST(UnexplainedPhase, IsZeroWhereNoiseExplainsTheFrames) {
  for (const int frames : {4, 5, 12}) {
    const CoveredFringes sound(frames, {});
    const auto pixels = sound.unexplained_rad.pixels();
    EXPECT_EQ(std::count(pixels.begin(), pixels.end(), 0.0F), std::ssize(pixels)) << frames;
  }
  EXPECT_TRUE(CoveredFringes(3, {}).unexplained_rad.empty());
}

TEST(UnexplainedPhase, IsLargeWhereSomethingElseCoversOneOrTwoFrames) {
  for (const std::vector<std::size_t>& covered :
       {std::vector<std::size_t>{2}, std::vector<std::size_t>{2, 3}}) {
    const CoveredFringes fringes(4, covered);
    int large = 0;
    for (int y = 0; y < fringes.unexplained_rad.height(); ++y) {
      for (int x = 0; x < fringes.unexplained_rad.width(); ++x) {
        if (CoveredFringes::is_inside(x, y)) {
          large += fringes.unexplained_rad(x, y) > 0.1F ? 1 : 0;
        } else if (CoveredFringes::is_outside(x, y)) {
          EXPECT_EQ(fringes.unexplained_rad(x, y), 0.0F) << x << " " << y;
        }
      }
    }
    // Some phases hide the fault of two frames.
    EXPECT_GE(large, covered.size() == 1 ? 1600 : 1400) << "of 1600";
  }
}

TEST(CountUnexplained, DiscardsThePixelsThatAreCovered) {
  CoveredFringes fringes(4, {2});
  WrappedPhase& map = fringes.map;
  const double share = count_unexplained(
      fringes.unexplained_rad, {}, {map.phase_rad, map.sigma_rad, map.status, map.systematic_rad});
  EXPECT_NEAR(share, 42.0 * 42.0 / (200.0 * 160.0), 0.01);
  EXPECT_TRUE(std::isnan(map.phase_rad(80, 80)));
  EXPECT_EQ(map.status(80, 80), PixelStatus::Contradicting);
  EXPECT_EQ(map.status(20, 20), PixelStatus::Measured);
  EXPECT_EQ(map.systematic_rad(20, 20), 0.0F);
  const std::string place = place_of_unexplained(fringes.unexplained_rad, 0.1F);
  EXPECT_NE(describe_contradicting("fringe", share, place), "");
  EXPECT_EQ(describe_contradicting("fringe", 0.001, place), "");
}

TEST(PlaceOfUnexplained, IsThatOfMostPixelsThatAreCovered) {
  EXPECT_EQ(place_of_unexplained(CoveredFringes(4, {}).unexplained_rad, 0.1F), "");
  int left = 0;
  int right = 0;
  int top = 0;
  int bottom = 0;
  const std::string place = place_of_unexplained(CoveredFringes(4, {2}).unexplained_rad, 0.1F);
  ASSERT_EQ(std::sscanf(
                place.c_str(), "columns %d to %d and rows %d to %d", &left, &right, &top, &bottom),
            4)
      << place;
  EXPECT_NEAR(left, CoveredFringes::kFrom, 3);
  EXPECT_NEAR(right, CoveredFringes::kTo - 1, 3);
  EXPECT_NEAR(top, CoveredFringes::kFrom, 3);
  EXPECT_NEAR(bottom, CoveredFringes::kTo - 1, 3);
}

TEST(UnexplainedPhase, HasNoGapsWhereTwoFramesAreCovered) {
  // At some phases the faults of two frames cancel, in stripes along the fringes.
  const CoveredFringes fringes(4, {2, 3});
  int large = 0;
  for (int y = CoveredFringes::kFrom; y < CoveredFringes::kTo; ++y)
    for (int x = CoveredFringes::kFrom; x < CoveredFringes::kTo; ++x)
      large += fringes.unexplained_rad(x, y) > 0.1F ? 1 : 0;
  EXPECT_GE(large, 1580) << "of 1600";
}

TEST(CountUnexplained, CountsTheErrorOfAFaintShadow) {
  // Frame 2 of five is dimmer by 3 % of the modulation, and the noise by far less.
  CoveredFringes fringes(5, {});
  auto& image = std::get<Image<std::uint16_t>>(fringes.stack.frames[2]);
  for (int y = CoveredFringes::kFrom; y < CoveredFringes::kTo; ++y)
    for (int x = CoveredFringes::kFrom; x < CoveredFringes::kTo; ++x)
      image(x, y) = static_cast<std::uint16_t>(image(x, y) - 1200);
  WrappedPhase map = wrap_phase(fringes.stack, fringes.fitted.algorithm, kCoveredNoise);
  count_unexplained(unexplained_phase(fringes.stack, fringes.fitted, kCoveredNoise),
                    {},
                    {map.phase_rad, map.sigma_rad, map.status, map.systematic_rad});
  double square = 0.0;
  double pixels = 0.0;
  for (int y = CoveredFringes::kFrom + 3; y < CoveredFringes::kTo - 3; ++y) {
    for (int x = CoveredFringes::kFrom + 3; x < CoveredFringes::kTo - 3; ++x) {
      const double error = wrap_rad(static_cast<double>(map.phase_rad(x, y)) - tilted_plane(x, y));
      const double sigma = std::hypot(static_cast<double>(map.sigma_rad(x, y)),
                                      static_cast<double>(map.systematic_rad(x, y)));
      square += std::pow(error / sigma, 2);
      pixels += 1.0;
    }
  }
  EXPECT_NEAR(std::sqrt(square / pixels), 1.0, 0.25);
}

}  // namespace
}  // namespace frangia
