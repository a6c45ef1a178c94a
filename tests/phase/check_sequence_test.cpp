#include "frangia/phase/temporal/check_sequence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/temporal/unwrap_sequence.h"
#include "frangia/phase/waveform/fringe_response.h"

#include "support/display_fringes.h"

namespace frangia {
namespace {

constexpr int kViewWidth = 320;
constexpr int kViewHeight = 60;
constexpr double kDisplayColumns = 640.0;  ///< projector columns

Projector checked_display() {
  Projector projector;
  projector.model = CameraModel{.width_px = 640, .height_px = 480, .focal_px = {800.0, 800.0}};
  return projector;
}

std::vector<double> shifts_over_a_turn(int frames) {
  std::vector<double> shifts;
  for (int k = 0; k < frames; ++k)
    shifts.push_back(kTwoPi * k / frames);
  return shifts;
}

/// The projector column that lights a pixel: a step and a bulge over most of the field.
double column_at(int x, int y) {
  const double bulge = 30.0 * std::sin(0.02 * x + 0.05 * y);
  return 60.0 + 1.6 * x + bulge + (x > 200 ? 25.0 : 0.0);
}

/// The frames that a projector of a display gamma shows with `shown`, declared as `declared`.
FrameStack shown_frames(const Pattern& shown,
                        const Pattern& declared,
                        unsigned seed,
                        double gamma = 1.0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, 1.5);
  FrameStack stack{.pattern = declared, .frames = {}, .white_level = 255};
  for (const double shift : shown.shifts_rad) {
    Image<std::uint8_t> image(kViewWidth, kViewHeight);
    for (int y = 0; y < kViewHeight; ++y) {
      for (int x = 0; x < kViewWidth; ++x) {
        const double phase = kTwoPi * column_at(x, y) / shown.period_px;
        const double light = std::pow(0.5 + 0.5 * std::cos(phase + shift), gamma);
        image(x, y) =
            static_cast<std::uint8_t>(std::lround(40.0 + 160.0 * light + noise(generator)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

std::vector<Pattern> whole_counts(const std::vector<double>& fringes, int frames = 4) {
  std::vector<Pattern> patterns;
  for (const double count : fringes) {
    patterns.push_back({.name = "p" + std::to_string(patterns.size()),
                        .period_px = kDisplayColumns / count,
                        .shifts_rad = shifts_over_a_turn(frames)});
  }
  return patterns;
}

SequenceCheck checked(const std::vector<Pattern>& shown,
                      const std::vector<Pattern>& declared,
                      unsigned seed = 1,
                      double gamma = 1.0,
                      const std::vector<std::vector<std::vector<double>>>& orders_rad = {}) {
  const NoiseModel noise{1.5 * 1.5 + 1.0 / 12.0, 0.0};
  std::vector<FrameStack> stacks;
  for (std::size_t m = 0; m < shown.size(); ++m)
    stacks.push_back(shown_frames(shown[m], declared[m], seed + static_cast<unsigned>(m), gamma));
  std::vector<SequenceFrames> maps;
  for (const FrameStack& stack : stacks)
    maps.push_back({&stack, least_squares(stack.pattern.shifts_rad)});
  for (std::size_t m = 0; m < orders_rad.size(); ++m)
    maps[m].orders_rad = orders_rad[m];
  return check_sequence(maps,
                        noise,
                        checked_display(),
                        find_sequence_method(declared, checked_display()).has_value());
}

void expect_only(const SequenceCheck& found, const std::string& pattern, const std::string& keys) {
  EXPECT_TRUE(found.decided);
  EXPECT_FALSE(found.consistent);
  ASSERT_EQ(found.fits.size(), 1U) << describe(found);
  EXPECT_EQ(found.fits.front().patterns, std::vector{pattern}) << describe(found);
  EXPECT_EQ(found.fits.front().keys, keys) << describe(found);
}

/// As `checked` of three frames of a linear projector whose waveform is known.
SequenceCheck checked_linear(const std::vector<Pattern>& declared,
                             const std::vector<FrameStack>& stacks) {
  std::vector<SequenceFrames> maps;
  for (const FrameStack& stack : stacks) {
    maps.push_back({&stack, least_squares(stack.pattern.shifts_rad)});
    maps.back().systematic_rad = 0.0;
  }
  return check_sequence(maps,
                        NoiseModel{1.5 * 1.5 + 1.0 / 12.0, 0.0},
                        checked_display(),
                        find_sequence_method(declared, checked_display()).has_value());
}

TEST(CheckSequence, NamesAStartOfThreeFramesWhoseWaveformIsKnown) {
  const std::vector<Pattern> declared = whole_counts({1, 9, 53}, 3);
  std::vector<Pattern> shown = declared;
  for (double& shift : shown[2].shifts_rad)
    shift += kPi;
  std::vector<FrameStack> stacks;
  for (std::size_t m = 0; m < shown.size(); ++m)
    stacks.push_back(shown_frames(shown[m], declared[m], 1 + static_cast<unsigned>(m)));
  const SequenceCheck found = checked_linear(declared, stacks);
  EXPECT_FALSE(found.consistent);
  ASSERT_EQ(found.fits.size(), 1U) << describe(found);
  EXPECT_EQ(found.fits.front().what, "a start of 180 degrees, not 0 degrees");
}

TEST(CheckSequence, CountsThePhaseErrorOfAFrameOfOtherLight) {
  const std::vector<Pattern> declared = whole_counts({1, 8, 40}, 3);
  std::vector<FrameStack> sound;
  for (std::size_t m = 0; m < declared.size(); ++m)
    sound.push_back(shown_frames(declared[m], declared[m], 1 + static_cast<unsigned>(m)));
  for (const double ripple_rad : checked_linear(declared, sound).ripples_rad)
    EXPECT_LT(ripple_rad, 0.02);
  const auto half = [](double counts) { return 0.5 * counts; };
  const auto full = [](double /*counts*/) { return 250.0; };
  for (const std::function<double(double)>& of_frame : {std::function(half), {full}}) {
    std::vector<FrameStack> stacks = sound;
    for (std::uint8_t& counts : std::get<Image<std::uint8_t>>(stacks[2].frames[1]).pixels())
      counts = static_cast<std::uint8_t>(of_frame(counts));
    // The truth: least squares of A + B cos(phi - 120 k) with the changed frame 1.
    double square = 0.0;
    constexpr int kPlaces = 360;
    for (int i = 0; i < kPlaces; ++i) {
      const double phi = kTwoPi * i / kPlaces;
      double cosine = 0.0;
      double sine = 0.0;
      for (int k = 0; k < 3; ++k) {
        const double shown = 120.0 + 80.0 * std::cos(phi + kTwoPi * k / 3.0);
        const double counts = k == 1 ? of_frame(shown) : shown;
        cosine += counts * std::cos(kTwoPi * k / 3.0);
        sine -= counts * std::sin(kTwoPi * k / 3.0);
      }
      square += std::pow(wrap_rad(std::atan2(sine, cosine) - phi), 2) / kPlaces;
    }
    const SequenceCheck found = checked_linear(declared, stacks);
    ASSERT_EQ(found.ripples_rad.size(), 3U);
    EXPECT_GT(found.ripples_rad[2], 0.5 * std::sqrt(square));
    EXPECT_LT(found.ripples_rad[2], 1.2 * std::sqrt(square));
  }
}

TEST(CheckSequence, TakesAResponseThatIsCorrectedForNoErrorOfThePhase) {
  constexpr double kGamma = 1.8;
  const std::vector<Pattern> declared = whole_counts({1, 8, 40}, 3);
  FringeWaveform waveform;
  for (int order = 2; order <= 6; ++order)
    waveform.harmonics.emplace_back(testing::gamma_harmonic(kGamma, order));
  // A part that covers two fringes of the second pattern: the errors of the first are not averaged.
  std::vector<FrameStack> stacks;
  for (std::size_t m = 0; m < declared.size(); ++m) {
    stacks.push_back(shown_frames(declared[m], declared[m], 1 + static_cast<unsigned>(m), kGamma));
    for (Frame& frame : stacks.back().frames)
      for (int y = 0; y < kViewHeight; ++y)
        for (int x = 80; x < kViewWidth; ++x)
          std::get<Image<std::uint8_t>>(frame)(x, y) = 40;
  }
  const auto largest_ripple = [&](bool corrected) {
    std::vector<SequenceFrames> maps;
    for (const FrameStack& stack : stacks) {
      maps.push_back({&stack, least_squares(stack.pattern.shifts_rad)});
      if (corrected) {
        maps.back().correction =
            response_table(waveform, maps.back().algorithm, stack.pattern.shifts_rad);
      }
    }
    const SequenceCheck found =
        check_sequence(maps, NoiseModel{1.5 * 1.5 + 1.0 / 12.0, 0.0}, checked_display(), true);
    EXPECT_TRUE(found.consistent);
    return *std::max_element(found.ripples_rad.begin(), found.ripples_rad.end());
  };
  EXPECT_GT(largest_ripple(false), 0.1);
  EXPECT_LT(largest_ripple(true), 0.03);
}

TEST(CheckSequence, BlamesNoSoundSequenceOfADisplayThatIsNotLinear) {
  for (const double gamma : {1.8, 2.2, 2.6}) {
    for (const int frames : {3, 4, 5, 6, 8, 12}) {
      for (const auto& fringes :
           std::vector<std::vector<double>>{{1, 8, 64}, {1, 4, 16}, {64, 58, 53}}) {
        const std::vector<Pattern> patterns = whole_counts(fringes, frames);
        const SequenceCheck check = checked(patterns, patterns, 1, gamma);
        EXPECT_TRUE(check.consistent) << "gamma " << gamma << ", " << frames << " frames, up to "
                                      << fringes.back() << " fringes: " << describe(check);
      }
    }
  }
}

TEST(CheckSequence, BlamesNoSoundSequence) {
  for (const std::vector<double>& fringes :
       {std::vector{1.0, 8.0, 64.0}, {53.0, 58.0, 64.0}, {1.0, 2.0, 4.0, 8.0, 16.0}, {1.0, 16.0}}) {
    for (const int frames : {3, 4, 5}) {
      const auto patterns = whole_counts(fringes, frames);
      const SequenceCheck found = checked(patterns, patterns);
      EXPECT_TRUE(found.decided) << fringes.back() << " " << frames;
      EXPECT_TRUE(found.consistent) << describe(found);
    }
  }
}

TEST(CheckSequence, NamesThePatternThatBegan180DegreesLate) {
  for (const std::vector<double>& fringes : {std::vector{1.0, 8.0, 64.0}, {53.0, 58.0, 64.0}}) {
    for (std::size_t late = 1; late < 3; ++late) {
      const auto declared = whole_counts(fringes);
      auto shown = declared;
      for (double& shift : shown[late].shifts_rad)
        shift += kPi;
      expect_only(
          checked(shown, declared), "p" + std::to_string(late), "shifts_deg = [180, 270, 0, 90]");
    }
  }
}

TEST(CheckSequence, NamesTheCoarsestPatternThatBeganLateByTheEndsOfTheField) {
  const auto declared = whole_counts({1.0, 8.0, 64.0});
  auto shown = declared;
  for (double& shift : shown[0].shifts_rad)
    shift += kPi;
  const SequenceCheck found = checked(shown, declared);
  EXPECT_GT(found.split_rows, 0.9);
  expect_only(found, "p0", "shifts_deg = [180, 270, 0, 90]");
}

TEST(CheckSequence, NamesAStartThatIsNoMultipleOfAQuarterTurn) {
  const auto declared = whole_counts({1.0, 6.0, 36.0});
  auto shown = declared;
  for (double& shift : shown[2].shifts_rad)
    shift += rad_from_deg(130.0);
  const SequenceCheck found = checked(shown, declared);
  ASSERT_EQ(found.fits.size(), 1U) << describe(found);
  EXPECT_EQ(found.fits.front().patterns, std::vector<std::string>{"p2"});
  EXPECT_NEAR(std::stod(found.fits.front().what.substr(11)), 130.0, 2.0) << describe(found);
}

TEST(CheckSequence, NamesTheStartThatKeepsTheSurfaceWholeOfThoseThatFitAlike) {
  const auto declared = whole_counts({53.0, 58.0, 64.0});
  auto shown = declared;
  for (double& shift : shown[0].shifts_rad)
    shift += rad_from_deg(37.0);
  const SequenceCheck found = checked(shown, declared);
  ASSERT_EQ(found.fits.size(), 1U) << describe(found);
  EXPECT_EQ(found.fits.front().patterns, std::vector<std::string>{"p0"});
  EXPECT_NEAR(std::stod(found.fits.front().what.substr(11)), 37.0, 1.0) << describe(found);
}

TEST(CheckSequence, NamesReversedShifts) {
  const auto declared = whole_counts({1.0, 8.0, 64.0}, 5);
  for (std::size_t turned = 0; turned < 3; ++turned) {
    auto shown = declared;
    for (double& shift : shown[turned].shifts_rad)
      shift = -shift;
    const SequenceCheck found = checked(shown, declared);
    expect_only(found, "p" + std::to_string(turned), "shifts_deg = [0, 288, 216, 144, 72]");
    if (!found.fits.empty()) {
      EXPECT_EQ(found.fits.front().kind, SequenceFaultKind::Direction);
    }
  }
}

TEST(CheckSequence, DecidesWhichFramesAreExchangedOfThoseThatLookAlike) {
  const auto declared = whole_counts({1.0, 8.0, 64.0});
  for (std::size_t map = 0; map < 3; ++map) {
    auto shown = declared;
    std::swap(shown[map].shifts_rad[0], shown[map].shifts_rad[1]);
    auto others = declared[map].shifts_rad;
    std::swap(others[2], others[3]);
    std::vector<std::vector<std::vector<double>>> orders_rad(3);
    orders_rad[map] = {others, shown[map].shifts_rad};
    expect_only(checked(shown, declared, 1, 1.0, orders_rad),
                "p" + std::to_string(map),
                "shifts_deg = [90, 0, 180, 270]");
  }
}

TEST(CheckSequence, NamesAWrongPeriod) {
  const auto declared = whole_counts({1.0, 8.0, 64.0});
  for (const double period : {7.0, 12.5, 20.0}) {
    auto shown = declared;
    shown[2].period_px = period;
    expect_only(checked(shown, declared), "p2", fmt::format("period_px = {:g}", period));
  }
}

TEST(CheckSequence, NamesAWrongPeriodWhereTheOthersAloneDoNotTellThePlace) {
  const auto declared = whole_counts({53.0, 58.0, 64.0});  // the beat of two repeats 5 to 11 times
  for (const double period : {9.0, 11.5}) {
    auto shown = declared;
    shown[2].period_px = period;
    expect_only(checked(shown, declared), "p2", fmt::format("period_px = {:g}", period));
  }
}

TEST(CheckSequence, NamesASmallStartOfTheFinestPattern) {
  // 37 degrees of 64 fringes are 4.6 degrees of 8: much more than their mean, less than chance.
  const auto declared = whole_counts({1.0, 8.0, 64.0});
  auto shown = declared;
  for (double& shift : shown[2].shifts_rad)
    shift += rad_from_deg(37.0);
  for (unsigned seed = 1; seed < 6; ++seed) {
    expect_only(checked(shown, declared, 10 * seed), "p2", "shifts_deg = [37, 127, 217, 307]");
    EXPECT_TRUE(checked(declared, declared, 10 * seed, 2.2).consistent) << seed;
  }
}

TEST(CheckSequence, NamesPatternsThatAreExchanged) {
  const auto declared = whole_counts({53.0, 58.0, 64.0});
  auto shown = declared;
  std::swap(shown[0].period_px, shown[2].period_px);
  const SequenceCheck found = checked(shown, declared);
  ASSERT_EQ(found.fits.size(), 1U) << describe(found);
  EXPECT_EQ(found.fits.front().kind, SequenceFaultKind::Exchanged);
  EXPECT_EQ(found.fits.front().patterns, (std::vector<std::string>{"p0", "p2"}));
}

TEST(CheckSequence, NamesBothStartsBetweenWhichTheFramesDoNotDecide) {
  // Half a fringe in 2 is a quarter of a fringe in 1, and 4 fringes do not see it.
  const auto declared = whole_counts({2.0, 4.0, 8.0});
  auto shown = declared;
  for (double& shift : shown[1].shifts_rad)
    shift += kPi;
  const SequenceCheck found = checked(shown, declared);
  EXPECT_FALSE(found.consistent);
  EXPECT_GT(found.fits.size(), 1U) << describe(found);
}

TEST(CheckSequence, NamesASequenceThatBeganWithAnotherFrame) {
  const auto declared = whole_counts({1.0, 8.0, 64.0}, 3);
  auto shown = declared;
  for (Pattern& pattern : shown)
    std::rotate(
        pattern.shifts_rad.begin(), pattern.shifts_rad.begin() + 1, pattern.shifts_rad.end());
  std::vector<FrameStack> stacks;
  for (std::size_t m = 0; m < shown.size(); ++m)
    stacks.push_back(shown_frames(shown[m], declared[m], 1 + static_cast<unsigned>(m)));
  const SequenceCheck found = checked_linear(declared, stacks);
  EXPECT_FALSE(found.consistent);
  EXPECT_TRUE(std::any_of(found.fits.begin(), found.fits.end(), [](const SequenceFault& one) {
    return one.patterns.size() == 3 && one.keys == "shifts_deg = [120, 240, 0]";
  })) << describe(found);
}

TEST(CheckSequence, SaysThatUnrelatedPatternsDisagree) {
  const auto declared = whole_counts({1.0, 8.0, 64.0});
  auto shown = declared;
  shown[1].period_px = 33.0;
  shown[1].shifts_rad = {0.3, 1.0, 2.9, 4.0};
  shown[2].period_px = 17.0;
  const SequenceCheck found = checked(shown, declared);
  EXPECT_FALSE(found.consistent);
  EXPECT_TRUE(found.fits.empty()) << describe(found);
}

TEST(CheckSequence, DecidesNothingForFringesThatNoiseMakesUnrelated) {
  const auto declared = whole_counts({1.0, 200.0});
  const SequenceCheck found = checked(declared, declared);
  EXPECT_FALSE(found.decided);
  EXPECT_TRUE(found.consistent);
}

}  // namespace
}  // namespace frangia
