#include "frangia/phase/waveform/fit_waveform.h"

#include <cmath>
#include <complex>
#include <numeric>
#include <random>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "support/display_fringes.h"
#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::display_frames;
using testing::DisplayScene;
using testing::equal_shifts;
using testing::gamma_harmonic;

NoiseModel noise_of(const DisplayScene& scene) {
  return {.floor_counts2 = scene.noise_counts * scene.noise_counts + 1.0 / 12.0};
}

WaveformFit fit(const DisplayScene& scene, int frames) {
  const std::vector<double> shifts = equal_shifts(frames, kTwoPi / frames);
  return fit_waveform(display_frames(scene, shifts), shifts, noise_of(scene));
}

std::vector<double> some_gains(int frames) {
  std::vector<double> gains;
  for (int k = 0; k < frames; ++k)
    gains.push_back(0.02 * std::sin(2.3 * k * k + 1.0));
  return gains;
}

TEST(FitWaveform, FindsTheSecondHarmonicOfAGammaFromThreeFramesOrMore) {
  for (const double gamma : {1.4, 1.8, 2.2}) {
    for (const int frames : {3, 4, 5, 6, 12}) {
      const WaveformFit found = fit({.gamma = gamma}, frames);
      EXPECT_EQ(found.largest_harmonic(), 2) << frames;
      EXPECT_NEAR(found.waveform.harmonics[0].real(), gamma_harmonic(gamma, 2), 0.008) << frames;
      EXPECT_NEAR(found.waveform.harmonics[0].imag(), 0.0, 0.003) << frames;
      EXPECT_EQ(found.flicker(), 0.0) << frames;
      EXPECT_EQ(found.flicker_error_rad, 0.0) << frames;
    }
  }
}

TEST(FitWaveform, FindsTheThirdHarmonicOfASaturatingDisplay) {
  const auto waveform = [](double phase) { return std::cos(phase) - 0.06 * std::cos(3.0 * phase); };
  for (const int frames : {4, 5, 6, 12}) {
    const WaveformFit found = fit({.peak_counts = 160.0, .waveform = waveform}, frames);
    EXPECT_EQ(found.largest_harmonic(), 3) << frames;
    EXPECT_NEAR(found.waveform.harmonics[1].real(), -0.06, 0.006) << frames;
  }
}

TEST(FitWaveform, TakesTheThirdHarmonicOfThreeFramesForNoSecondOne) {
  const auto waveform = [](double phase) { return std::cos(phase) - 0.06 * std::cos(3.0 * phase); };
  for (const double texture : {0.0, 0.5}) {
    const WaveformFit found =
        fit({.peak_counts = 160.0, .texture = texture, .waveform = waveform}, 3);
    EXPECT_LT(found.waveform.amplitude(2), 0.012) << texture;
  }
}

TEST(FitWaveform, FindsNothingInSoundFrames) {
  for (const int frames : {3, 4, 5, 6, 12}) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
      const WaveformFit found = fit({.texture = 0.8, .defocus = 0.3, .seed = seed}, frames);
      EXPECT_EQ(found.largest_harmonic(), 0) << frames;
      EXPECT_TRUE(found.gains.empty()) << frames;
      EXPECT_EQ(found.flicker_error_rad, 0.0) << frames;
    }
  }
}

TEST(FitWaveform, FindsTheGainsOfFiveFramesOrMore) {
  for (const int frames : {5, 6, 12}) {
    const std::vector<double> gains = some_gains(frames);
    const WaveformFit found = fit({.dark_counts = 0.5, .gains = gains}, frames);
    EXPECT_EQ(found.largest_harmonic(), 0) << frames;
    ASSERT_EQ(found.gains.size(), gains.size());
    const double mean =
        std::accumulate(gains.begin(), gains.end(), 0.0) / static_cast<double>(frames);
    for (std::size_t k = 0; k < gains.size(); ++k)
      EXPECT_NEAR(found.gains[k], gains[k] - mean, 1e-3) << frames;
  }
}

TEST(FitWaveform, FindsThePhaseErrorOfFlickerInThreeAndFourFrames) {
  for (const int frames : {3, 4}) {
    std::vector<double> gains = {0.02, -0.014, 0.001, 0.012};
    gains.resize(static_cast<std::size_t>(frames));
    const WaveformFit found = fit({.dark_counts = 0.5, .gains = gains}, frames);
    EXPECT_TRUE(found.gains.empty());
    // sum of g_k A exp(-i shift_k) 2 / N, over B; A / B lies between 0.95 and 1.15.
    std::complex<double> offset = 0.0;
    for (int k = 0; k < frames; ++k) {
      offset +=
          gains[static_cast<std::size_t>(k)] * 2.0 / frames * std::polar(1.0, -kTwoPi * k / frames);
    }
    EXPECT_NEAR(found.flicker_error_rad / (std::abs(offset) / std::sqrt(2.0)), 1.05, 0.15);
  }
}

TEST(FitWaveform, TakesMotionForNeitherHarmonicsNorFlicker) {
  for (const int frames : {4, 5, 6, 12}) {
    const std::vector<double> nominal = equal_shifts(frames, kTwoPi / frames);
    std::vector<double> made = nominal;
    for (std::size_t k = 0; k < made.size(); ++k)
      made[k] += 0.03 * std::sin(5.1 * static_cast<double>(k * k) + 2.0);
    const DisplayScene scene;
    FrameStack stack = display_frames(scene, made);
    stack.pattern.shifts_rad = nominal;
    const WaveformFit found = fit_waveform(stack, nominal, noise_of(scene));
    EXPECT_EQ(found.largest_harmonic(), 0) << frames;
    EXPECT_TRUE(found.gains.empty()) << frames;
    EXPECT_FALSE(found.is_flicker) << frames;
  }
}

TEST(FitWaveform, CountsFlickerThatLeavesTheResidualOfMotion) {
  // I1 - I2 + I3 - I4 of gains g, g, -g, -g vanishes at multiple 0 of the phase.
  const WaveformFit found = fit({.dark_counts = 0.5, .gains = {0.02, 0.02, -0.02, -0.02}}, 4);
  EXPECT_FALSE(found.is_flicker);
  // |sum of g_k exp(-i shift_k)| / 2 times A / B, as above; rms over the fringe.
  EXPECT_NEAR(found.flicker_error_rad, 1.05 * 0.02, 0.004);
}

TEST(FitWaveform, CountsFlickerOfAPartThatIsTooSmallToCompareContrasts) {
  const std::vector<double> nominal = equal_shifts(4, kTwoPi / 4.0);
  const auto fit_small = [&](const DisplayScene& scene) {
    FrameStack stack = display_frames(scene, nominal);
    for (Frame& frame : stack.frames) {  // two by two tiles of eight by eight
      std::visit(
          [](auto& image) {
            for (int y = 0; y < image.height(); ++y)
              for (int x = 0; x < image.width(); ++x)
                if (x >= 80 || y >= 70) image(x, y) = 12;
          },
          frame);
    }
    return fit_waveform(stack, nominal, noise_of(scene), {.samples = 120'000});
  };
  const std::vector<double> gains{0.03, -0.03, 0.01, -0.02};
  double square = 0.0;
  for (const double gain : gains)
    square += gain * gain / 4.0;
  const double expected = std::sqrt(2.0 / 4.0 * square) * 1.05;  // of gains of this size
  const double found = fit_small({.gains = gains}).flicker_error_rad;
  EXPECT_GT(found, 0.5 * expected);
  EXPECT_LT(found, 2.5 * expected);
  EXPECT_EQ(fit_small({}).flicker_error_rad, 0.0);
}

TEST(FitWaveform, IgnoresSaturatedPixelsAndCountsThoseCutOffAtZero) {
  for (const int frames : {3, 4, 6}) {
    EXPECT_EQ(fit({.peak_counts = 330.0}, frames).largest_harmonic(), 0) << frames;
    EXPECT_EQ(fit({.peak_counts = 120.0, .dark_counts = -20.0}, frames).largest_harmonic(), 2)
        << frames;
  }
}

TEST(FitWaveform, FindsNothingInTooFewPixels) {
  const WaveformFit found = fit({.width = 30, .height = 20, .gamma = 2.2}, 4);
  EXPECT_EQ(found.largest_harmonic(), 0);
}

TEST(FitWaveform, TakesTheShadingOfARoundPartForNoFlicker) {
  // A shaft in a lit room: its contrast falls from the side of the projector to the other one.
  const std::vector<double> shifts = equal_shifts(4, kTwoPi / 4);
  for (const double start : {0.0, 0.8, 1.6, 2.4, 3.2, 4.0, 4.8, 5.6}) {
    FrameStack stack{.pattern = {.period_px = 120.0, .shifts_rad = shifts}, .frames = {}};
    std::mt19937 generator(1);
    std::normal_distribution<double> noise(0.0, 1.5);
    for (const double shift : shifts) {
      Image<std::uint8_t> image(560, 400, 3);
      for (int y = 40; y < 360; ++y) {
        for (int x = 182; x < 378; ++x) {
          const double turned = std::asin((x - 280.0) / 100.0);
          const double lit = std::max(0.0, std::cos(turned + 0.35));
          const double phase = start + kTwoPi * (x + 0.02 * y) / stack.pattern.period_px + shift;
          const double counts = 12.0 + 180.0 * lit * (0.5 + 0.5 * std::cos(phase));
          image(x, y) = static_cast<std::uint8_t>(std::lround(counts + noise(generator)));
        }
      }
      stack.frames.emplace_back(std::move(image));
    }
    const WaveformFit found = fit_waveform(stack, shifts, NoiseModel{2.25 + 1.0 / 12.0, 0.0});
    EXPECT_EQ(found.flicker_error_rad, 0.0) << start;
    EXPECT_EQ(found.largest_harmonic(), 0) << start;
  }
}

TEST(FitWaveform, TakesTheShadingOfAPartOfOneFringeForNoHarmonic) {
  // A quarter of a fringe over the image, brighter in its middle.
  const std::vector<double> shifts = equal_shifts(3, kTwoPi / 3);
  FrameStack stack{.pattern = {.period_px = 1280.0, .shifts_rad = shifts}, .frames = {}};
  for (const double shift : shifts) {
    Image<std::uint8_t> image(320, 240);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const double across = (x - 160.0) / 160.0;
        const double albedo = 100.0 * (1.0 - 0.5 * across * across);
        const double phase = 2.0 + 1.5 * x / 320.0 + 0.1 * std::sin(0.1 * y);
        image(x, y) =
            static_cast<std::uint8_t>(std::lround(albedo * (1.0 + 0.9 * std::cos(phase + shift))));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  const WaveformFit found = fit_waveform(stack, shifts, NoiseModel{1.0 / 12.0, 0.0});
  for (const std::complex<double>& harmonic : found.waveform.harmonics)
    EXPECT_EQ(std::abs(harmonic), 0.0);
}

}  // namespace
}  // namespace frangia
