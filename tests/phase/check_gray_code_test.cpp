#include "frangia/phase/gray/check_gray_code.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {
namespace {

constexpr int kCodedWidth = 320;
constexpr int kCodedHeight = 64;
constexpr double kCodedPeriod = 20.0;

/// The projector column, of 640, that lights a pixel.
double coded_column(int x, int y) {
  return 20.0 + 1.85 * x + 8.0 * std::sin(0.03 * x + 0.1 * y);
}

/// The frames of a Gray code of 10 px stripes and fringes of 20 px, by their published formulas.
struct CodedScene {
  FrameStack gray;
  FrameStack fringes;

  explicit CodedScene(InvertedFrames inverted = InvertedFrames::None,
                      bool is_binary = false,
                      double (*column_of)(int, int) = coded_column) {
    std::mt19937 generator(3);
    std::normal_distribution<double> noise(0.0, 1.5);
    const auto image_of = [&](const auto& light) {
      Image<std::uint8_t> image(kCodedWidth, kCodedHeight);
      for (int y = 0; y < kCodedHeight; ++y) {
        for (int x = 0; x < kCodedWidth; ++x) {
          image(x, y) = static_cast<std::uint8_t>(
              std::lround(110.0 + 70.0 * light(column_of(x, y)) + noise(generator)));
        }
      }
      return image;
    };
    gray.pattern = {.name = "gray", .kind = PatternKind::Gray, .bits = 6, .stripe_px = 10.0};
    gray.pattern.inverted = inverted;
    gray.pattern.is_binary = is_binary;
    fringes.pattern = {
        .name = "f", .period_px = kCodedPeriod, .shifts_rad = {0.0, 0.5 * kPi, kPi, 1.5 * kPi}};
    const auto add_bit = [&](int bit, double sign) {
      gray.frames.emplace_back(image_of([&](double column) {
        const auto number = static_cast<unsigned>(std::floor((column + 0.5) / 10.0));
        const unsigned code = is_binary ? number : number ^ (number / 2);
        return (code >> static_cast<unsigned>(5 - bit)) % 2 == 1 ? sign : -sign;
      }));
    };
    const bool alternating = inverted == InvertedFrames::Alternating;
    for (int bit = 0; bit < 6; ++bit) {
      add_bit(bit, 1.0);
      if (alternating) add_bit(bit, -1.0);
    }
    for (int bit = 0; bit < 6 && inverted == InvertedFrames::After; ++bit)
      add_bit(bit, -1.0);
    for (const double shift : fringes.pattern.shifts_rad) {
      fringes.frames.emplace_back(image_of(
          [&](double column) { return std::cos(kTwoPi * column / kCodedPeriod + shift); }));
    }
  }

  [[nodiscard]] SequenceCheck check() const {
    const NoiseModel noise{2.3, 0.0};
    return check_gray_code(gray,
                           wrap_phase(fringes, least_squares(fringes.pattern.shifts_rad), noise));
  }
};

void expect_only_fit(const SequenceCheck& found, const std::string& what) {
  EXPECT_TRUE(found.decided);
  EXPECT_FALSE(found.consistent);
  ASSERT_EQ(found.fits.size(), 1U) << describe(found);
  EXPECT_EQ(found.fits.front().what, what) << describe(found);
}

TEST(CheckGrayCode, BlamesNoSoundCode) {
  for (const auto inverted :
       {InvertedFrames::None, InvertedFrames::After, InvertedFrames::Alternating}) {
    for (const bool is_binary : {false, true}) {
      const SequenceCheck found = CodedScene(inverted, is_binary).check();
      EXPECT_TRUE(found.decided);
      EXPECT_TRUE(found.consistent) << describe(found);
      EXPECT_GT(found.agreement, 0.95);
    }
  }
}

TEST(CheckGrayCode, TakesDepthEdgesForNoBorders) {
  // The border of the widest stripes lies in the occluded gap, between columns that are no
  // neighbours: all changes of the first frame are at the depth edge.
  const auto occluded = [](int x, int y) {
    return 20.0 + 1.85 * x + 0.37 * y + (x + y / 3 > 150 ? 67.0 : 0.0);
  };
  const SequenceCheck found = CodedScene(InvertedFrames::None, false, occluded).check();
  EXPECT_TRUE(found.decided);
  EXPECT_TRUE(found.consistent) << describe(found);
}

TEST(CheckGrayCode, TakesDepthEdgesForNoMissingFrame) {
  // A part between the borders of the second frame, which is dark all over it. At steps in depth by
  // a whole fringe the number falls while the phase rises, as it would where that frame is wrong.
  const auto stepped = [](int x, int /*y*/) { return 205.0 + x - 20.0 * ((x + 5) / 70); };
  const SequenceCheck found = CodedScene(InvertedFrames::None, false, stepped).check();
  EXPECT_TRUE(found.decided);
  EXPECT_TRUE(found.consistent) << describe(found);
}

TEST(CheckGrayCode, NamesAStartBelowHalfAStripe) {
  CodedScene scene;
  for (double& shift : scene.fringes.pattern.shifts_rad)
    shift -= rad_from_deg(37.0);
  expect_only_fit(scene.check(), "a start of 0 degrees, not -37 degrees");
}

TEST(CheckGrayCode, NamesTwoFramesThatAreExchanged) {
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = a + 1; b < 6; ++b) {
      CodedScene scene;
      std::swap(scene.gray.frames[a], scene.gray.frames[b]);
      expect_only_fit(scene.check(),
                      "frames " + std::to_string(a) + " and " + std::to_string(b) + " exchanged");
    }
  }
}

TEST(CheckGrayCode, NamesAFrameThatIsInverted) {
  for (std::size_t frame = 1; frame < 6; ++frame) {
    CodedScene scene;
    for (std::uint8_t& counts : std::get<0>(scene.gray.frames[frame]).pixels())
      counts = static_cast<std::uint8_t>(220 - counts);
    expect_only_fit(scene.check(), "frame " + std::to_string(frame) + " inverted");
  }
}

TEST(CheckGrayCode, DoesNotDecideBetweenAnInvertedFirstFrameAndReversedFringes) {
  // Both mirror the code relative to the fringes; only the rig shows which one is mirrored.
  CodedScene scene;
  for (std::uint8_t& counts : std::get<0>(scene.gray.frames[0]).pixels())
    counts = static_cast<std::uint8_t>(220 - counts);
  const SequenceCheck found = scene.check();
  ASSERT_EQ(found.fits.size(), 2U) << describe(found);
  EXPECT_EQ(found.fits.front().what, "frame 0 inverted");
  EXPECT_EQ(found.fits.back().what, "shifts in the opposite direction");
}

TEST(CheckGrayCode, NamesBitsInTheOppositeOrder) {
  CodedScene scene;
  scene.gray.pattern.order = BitOrder::LeastSignificantFirst;
  const SequenceCheck found = scene.check();
  expect_only_fit(found, "its bits in the opposite order");
  EXPECT_EQ(found.fits.front().keys, "order = \"msb-first\"");
}

TEST(CheckGrayCode, NamesABinaryCode) {
  CodedScene scene(InvertedFrames::None, true);
  scene.gray.pattern.is_binary = false;
  const SequenceCheck found = scene.check();
  expect_only_fit(found, "the other code");
  EXPECT_EQ(found.fits.front().keys, "code = \"binary\"");
}

TEST(CheckGrayCode, NamesThePlaceOfInvertedFrames) {
  CodedScene scene(InvertedFrames::Alternating);
  scene.gray.pattern.inverted = InvertedFrames::After;
  expect_only_fit(scene.check(), "inverted frames that alternate");
}

TEST(CheckGrayCode, NamesEachFrameThatIsBlackOrWhite) {
  for (std::size_t frame = 0; frame < 6; ++frame) {
    for (const int level : {40, 220}) {
      CodedScene scene;
      for (std::uint8_t& counts : std::get<0>(scene.gray.frames[frame]).pixels())
        counts = static_cast<std::uint8_t>(level);
      expect_only_fit(scene.check(),
                      "a missing frame: frame " + std::to_string(frame) + " shows no stripes");
    }
  }
}

TEST(CheckGrayCode, NamesAFrameThatIsRepeated) {
  CodedScene scene;
  scene.gray.frames[3] = scene.gray.frames[2];
  expect_only_fit(scene.check(), "a missing frame: frame 3 repeats frame 2");
}

TEST(CheckGrayCode, NamesFramesThatAreLateByOne) {
  CodedScene scene;
  for (std::size_t frame = 5; frame > 2; --frame)
    scene.gray.frames[frame] = scene.gray.frames[frame - 1];
  expect_only_fit(scene.check(), "frames that are late by one from frame 3 on");
}

TEST(CheckGrayCode, TakesAnotherPeriodOnASmallPartForNoMissingFrame) {
  // The part lies within the widest stripes: their frames show no border, as they should.
  CodedScene scene(
      InvertedFrames::None, false, [](int x, int y) { return 330.0 + 0.45 * coded_column(x, y); });
  scene.fringes.pattern.period_px = 17.0;
  for (const SequenceFault& fault : scene.check().fits)
    EXPECT_NE(fault.kind, SequenceFaultKind::Missing) << fault.what;
}

TEST(CheckGrayCode, NamesTheStartOfTheFringes) {
  CodedScene scene;
  for (double& shift : scene.fringes.pattern.shifts_rad)
    shift -= kPi;
  const SequenceCheck found = scene.check();
  ASSERT_EQ(found.fits.size(), 1U) << describe(found);
  EXPECT_EQ(found.fits.front().kind, SequenceFaultKind::Start);
  EXPECT_EQ(found.fits.front().patterns, std::vector<std::string>{"f"});
}

TEST(CheckGrayCode, NamesAPeriodOfTheFringesByTheBordersOfTheStripes) {
  CodedScene scene;  // of 20 px
  scene.fringes.pattern.period_px = 17.0;
  expect_only_fit(scene.check(), "a period of 20 px, not 17 px");
}

TEST(CheckGrayCode, NamesNoPeriodOfFringesThatDriftAgainstTheStripes) {
  // The code is sound, and the phase of the fringes wanders by half a fringe over the part: no
  // period makes them begin at the borders of the stripes.
  for (int way = 1; way < 7; ++way) {
    CodedScene scene;
    for (std::size_t k = 0; k < scene.fringes.frames.size(); ++k) {
      auto& image = std::get<Image<std::uint8_t>>(scene.fringes.frames[k]);
      for (int y = 0; y < kCodedHeight; ++y) {
        for (int x = 0; x < kCodedWidth; ++x) {
          const double drift = 2.2 * std::sin(0.02 * way * x + 0.09 * y);
          const double phase = kTwoPi * coded_column(x, y) / kCodedPeriod + drift;
          image(x, y) = static_cast<std::uint8_t>(
              std::lround(110.0 + 70.0 * std::cos(phase + scene.fringes.pattern.shifts_rad[k])));
        }
      }
    }
    const SequenceCheck found = scene.check();
    for (const SequenceFault& fault : found.fits)
      EXPECT_NE(fault.kind, SequenceFaultKind::Period) << way << ": " << describe(found);
  }
}

TEST(CheckGrayCode, NamesAnotherWidthOfTheStripesAndThePeriodThatWouldFitInstead) {
  CodedScene scene;  // stripes of 10 px
  scene.gray.pattern.stripe_px = 5.0;
  const SequenceCheck found = scene.check();
  EXPECT_FALSE(found.consistent);
  ASSERT_EQ(found.fits.size(), 2U) << describe(found);
  EXPECT_EQ(found.fits[0].keys, "stripe_px = 10");
  EXPECT_EQ(found.fits[1].keys, "period_px = 10");  // fringes of 20 px for stripes of 10
}

TEST(CheckGrayCode, FindsStripesThatAreNarrowerThanDeclaredThoughTheyNeverContradictTheFringes) {
  CodedScene scene;  // stripes of half a fringe
  scene.gray.pattern.stripe_px = 20.0;
  const SequenceCheck found = scene.check();
  EXPECT_FALSE(found.consistent);
  ASSERT_FALSE(found.fits.empty());
  EXPECT_EQ(found.fits[0].keys, "stripe_px = 10");
}

}  // namespace
}  // namespace frangia
