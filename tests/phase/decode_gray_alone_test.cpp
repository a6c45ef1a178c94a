// A Gray code without fringes against the columns that the frames were made of.
#include "frangia/phase/gray/decode_gray_alone.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/pattern/gray_code.h"

#include "support/error_of.h"

namespace frangia::gray_alone {
namespace {

constexpr int kWidth = 240;
constexpr int kHeight = 24;
constexpr double kNoise = 1.2;  // counts
constexpr int kMargin = 22;     // a stripe, which has one border at the end of the image

Pattern code_of(double stripe_px, InvertedFrames inverted = InvertedFrames::After) {
  Pattern code{.name = "code", .kind = PatternKind::Gray};
  code.stripe_px = stripe_px;
  code.bits = static_cast<int>(std::ceil(std::log2(1024.0 / stripe_px)));
  code.inverted = inverted;
  return code;
}

/// The projector's column at a place of the image along the stripes' normal.
using Columns = std::function<double(double across, double along)>;

/// Frames of a camera whose pixels integrate over their width; `blur_px` widens them.
FrameStack frames_of(const Pattern& code,
                     const Columns& columns,
                     double blur_px = 1.0,
                     double noise_counts = kNoise) {
  constexpr int kSamples = 60;
  const bool rows = code.direction == FringeDirection::Horizontal;
  FrameStack stack{code, {}, 255};
  for (int frame = 0; frame < code.frame_count(); ++frame) {
    Image<std::uint8_t> image(rows ? kHeight : kWidth, rows ? kWidth : kHeight);
    for (int along = 0; along < kHeight; ++along) {
      for (int across = 0; across < kWidth; ++across) {
        double light = 0.0;
        for (int i = 0; i < kSamples; ++i) {
          const double at = across + blur_px * ((i + 0.5) / kSamples - 0.5);
          if (is_stripe_bright(code, frame, columns(at, along))) light += 1.0 / kSamples;
        }
        const auto stream = hash(
            hash(hash(11, static_cast<std::uint64_t>(frame)), static_cast<std::uint64_t>(along)),
            static_cast<std::uint64_t>(across));
        const double counts = 20.0 + 160.0 * light + noise_counts * normal_from(stream);
        image(rows ? along : across, rows ? across : along) =
            static_cast<std::uint8_t>(std::lround(counts));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

/// Errors of the decoded columns over their standard deviations.
struct Scatter {
  double rms_px = 0.0;
  double over_sigma = 0.0;
  double share = 0.0;  ///< of the pixels that were measured
};

Scatter scatter_of(const AbsolutePhase& phase, const Columns& columns, int margin = kMargin) {
  Scatter out;
  std::size_t count = 0;
  const bool rows = phase.pattern.direction == FringeDirection::Horizontal;
  for (int along = 0; along < kHeight; ++along) {
    for (int across = 0; across < kWidth; ++across) {
      const int x = rows ? along : across;
      const int y = rows ? across : along;
      if (across < margin || across >= kWidth - margin) continue;
      if (std::isnan(phase.phase_rad(x, y))) continue;
      const double px_per_rad = phase.pattern.period_px / kTwoPi;
      const double error = px_per_rad * phase.phase_rad(x, y) - columns(across, along);
      const double sigma =
          px_per_rad * std::hypot(phase.sigma_rad(x, y), phase.systematic_rad(x, y));
      out.rms_px += error * error;
      out.over_sigma += std::pow(error / sigma, 2);
      ++count;
    }
  }
  out.rms_px = std::sqrt(out.rms_px / static_cast<double>(count));
  out.over_sigma = std::sqrt(out.over_sigma / static_cast<double>(count));
  out.share = static_cast<double>(count) / ((kWidth - 2 * margin) * kHeight);
  return out;
}

/// Columns of a curved surface, at a slant to the pixels.
Columns surface(double columns_per_px) {
  return [=](double across, double along) {
    const double u = across + 0.31 * along;
    return 100.0 + columns_per_px * (u + 8.0 * std::sin(u / 40.0));
  };
}

Scatter decoded(const Pattern& code,
                const Columns& columns,
                double blur_px = 1.0,
                double noise_counts = kNoise) {
  const FrameStack stack = frames_of(code, columns, blur_px, noise_counts);
  Image<float> threshold;
  if (code.inverted == InvertedFrames::None) threshold = gray_threshold(stack, nullptr, nullptr);
  return scatter_of(decode_gray_alone(std::span(&stack, 1), threshold, estimate_gray_noise(stack)),
                    columns);
}

TEST(DecodeGrayAlone, StatesTheErrorsOfItsColumns) {
  struct Case {
    double stripe_px;
    double columns_per_px;
    double blur_px;
  };
  for (const Case& c : {Case{8.0, 0.8, 1.0},
                        Case{4.0, 0.8, 1.0},
                        Case{4.0, 0.8, 1.6},
                        Case{4.0, 0.8, 2.5},
                        Case{1.0, 0.37, 1.0},
                        Case{2.0, 1.9, 1.0},
                        Case{16.0, 1.1, 0.1}}) {
    const Scatter scatter = decoded(code_of(c.stripe_px), surface(c.columns_per_px), c.blur_px);
    SCOPED_TRACE(::testing::Message() << c.stripe_px << ' ' << c.columns_per_px << ' ' << c.blur_px
                                      << ": " << scatter.rms_px << " px");
    // Pixels whose light is exactly that of their width are better than what is stated.
    EXPECT_GT(scatter.over_sigma, c.blur_px == 1.0 ? 0.25 : 0.5);
    EXPECT_LT(scatter.over_sigma, 1.6);
    EXPECT_GT(scatter.share, 0.98);
  }
}

TEST(DecodeGrayAlone, PlacesBordersByTheLightOfThePixelsAroundThem) {
  // By linear interpolation between the two pixels at a border they are off by 0.08 px.
  for (const double columns_per_px : {0.8, 1.9})
    EXPECT_LT(decoded(code_of(8.0), surface(columns_per_px)).rms_px, 0.02 * columns_per_px);
}

TEST(DecodeGrayAlone, CountsAnEdgeBetweenFacesWithinAStripe) {
  // Faces of 2.1, 0.25 and 2.4 columns per pixel.
  const Columns steps = [](double across, double along) {
    const double u = across - 100.0 - 0.37 * along;
    const double slow = std::clamp(u, 0.0, 14.0);
    return 300.0 + (u < 0.0 ? 2.1 * u : 2.4 * (u - slow)) + 0.25 * slow;
  };
  const Scatter scatter = decoded(code_of(5.0), steps);
  EXPECT_GT(scatter.over_sigma, 0.3);
  EXPECT_LT(scatter.over_sigma, 1.5);
}

TEST(DecodeGrayAlone, InterpolatesBetweenTheBordersOfWideStripes) {
  // The centres of the stripes alone scatter by 8 / sqrt(12) = 2.3 px.
  EXPECT_LT(decoded(code_of(8.0), surface(0.8), 2.0).rms_px, 0.15);
}

TEST(DecodeGrayAlone, ExtrapolatesAtTheEndOfTheMeasuredPixels) {
  const FrameStack stack = frames_of(code_of(16.0), surface(0.8));
  const Scatter scatter = scatter_of(
      decode_gray_alone(std::span(&stack, 1), {}, estimate_gray_noise(stack)), surface(0.8), 0);
  EXPECT_LT(scatter.rms_px, 0.6) << "the centre of a stripe alone is wrong by up to 8 px";
  EXPECT_LT(scatter.over_sigma, 1.5);
}

TEST(DecodeGrayAlone, ReadsEveryOrderAndDirection) {
  for (const auto inverted : {InvertedFrames::None, InvertedFrames::Alternating}) {
    for (const bool binary : {false, true}) {
      for (const auto direction : {FringeDirection::Vertical, FringeDirection::Horizontal}) {
        Pattern code = code_of(4.0, inverted);
        code.is_binary = binary;
        code.direction = direction;
        code.order = binary ? BitOrder::LeastSignificantFirst : BitOrder::MostSignificantFirst;
        code.offset_px = 17.0;
        const Scatter scatter = decoded(code, surface(0.8));
        EXPECT_LT(scatter.rms_px, 0.4) << binary;
        EXPECT_GT(scatter.share, binary ? 0.6 : 0.95) << "a binary code is uncertain at borders";
      }
    }
  }
}

TEST(DecodeGrayAlone, LeavesOutBitsThatTheCameraDoesNotResolve) {
  // A pixel sees 3.4 stripes of one column.
  const Scatter scatter = decoded(code_of(1.0), surface(3.4));
  EXPECT_GT(scatter.share, 0.95);
  EXPECT_LT(scatter.rms_px, 2.0);
  EXPECT_GT(scatter.over_sigma, 0.25);  // as that of other pixels that integrate exactly
  EXPECT_LT(scatter.over_sigma, 1.5);
}

TEST(DecodeGrayAlone, LeavesOutBitsWhoseStripesAreAsNarrowAsPixels) {
  for (const double columns_per_px : {0.7, 0.9, 1.1, 1.3, 1.6, 2.1}) {
    // Pixels that see a point, and such that integrate.
    for (const auto& [blur_px, noise] : {std::pair{0.0, 0.0}, {0.02, kNoise}, {1.0, kNoise}}) {
      const Scatter scatter = decoded(code_of(1.0), surface(columns_per_px), blur_px, noise);
      SCOPED_TRACE(::testing::Message() << columns_per_px << ' ' << blur_px << ' ' << noise << ": "
                                        << scatter.rms_px << " px, " << scatter.over_sigma);
      EXPECT_GT(scatter.share, 0.95);
      EXPECT_LT(scatter.rms_px, (blur_px < 1.0 ? 0.3 : 0.05) * columns_per_px);
      EXPECT_GT(scatter.over_sigma, 0.25);
      EXPECT_LT(scatter.over_sigma, 1.5);
    }
  }
}

TEST(DecodeGrayAlone, EstimatesTheNoiseOfTheFrames) {
  for (const auto inverted : {InvertedFrames::After, InvertedFrames::None}) {
    const NoiseModel noise = estimate_gray_noise(frames_of(code_of(8.0, inverted), surface(0.8)));
    EXPECT_NEAR(std::sqrt(noise.variance(100.0)), std::hypot(kNoise, 0.29), 0.15);
  }
}

TEST(DecodeGrayAlone, LeavesOutPixelsWithoutLight) {
  FrameStack stack = frames_of(code_of(8.0), surface(0.8));
  for (Frame& frame : stack.frames) {
    for (int x = 0; x < 30; ++x)
      std::get<Image<std::uint8_t>>(frame)(x, 7) = static_cast<std::uint8_t>(20 + x % 2);
  }
  const AbsolutePhase phase =
      decode_gray_alone(std::span(&stack, 1), {}, estimate_gray_noise(stack));
  for (int x = 0; x < 30; ++x) {
    EXPECT_TRUE(std::isnan(phase.phase_rad(x, 7)));
    EXPECT_EQ(phase.status(x, 7), PixelStatus::Unmodulated);
  }
  EXPECT_FALSE(std::isnan(phase.phase_rad(60, 7)));
}

TEST(DecodeGrayAlone, RefusesWhatItCannotRead) {
  FrameStack stack = frames_of(code_of(8.0, InvertedFrames::None), surface(0.8));
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(decode_gray_alone(std::span(&stack, 1), {}, {}));
            }).find("has no inverted frames"),
            std::string::npos);
  stack.frames.pop_back();
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(decode_gray_alone(std::span(&stack, 1), {}, {}));
            }).find("has 6 frames instead of 7"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia::gray_alone
