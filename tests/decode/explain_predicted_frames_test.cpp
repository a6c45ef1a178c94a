// Three computed frames with one fault, and what coarser patterns predict of their pixels.
#include "frangia/decode/explain/explain_predicted_frames.h"

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

constexpr Eigen::Index kPixels = 2000;

/// Frame k of a pixel, whose place in the image is from 0 to 1.
using Shown =
    std::function<double(int frame, double mean, double modulation, double phase, double place)>;

Pattern three_steps() {
  Pattern out{.name = "fine", .period_px = 24.0};
  for (int k = 0; k < 3; ++k)
    out.shifts_rad.push_back(kTwoPi * k / 3.0);
  return out;
}

double fringe(int frame, double mean, double modulation, double phase) {
  return mean + modulation * std::cos(phase + kTwoPi * frame / 3.0);
}

FrameExplanation explained(const Shown& shown) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  PredictedFrames frames{Eigen::ArrayXXd(kPixels, 3),
                         Eigen::ArrayXd(kPixels),
                         Eigen::ArrayXd(kPixels),
                         Eigen::ArrayXd(kPixels)};
  const NoiseModel noise{.floor_counts2 = 1.0};
  for (Eigen::Index i = 0; i < kPixels; ++i) {
    const double place = static_cast<double>(i) / kPixels;
    const double modulation = 30.0 + 50.0 * uniform(generator);
    const double mean = 8.0 + 1.05 * modulation;
    const double phase = kTwoPi * uniform(generator);
    for (int k = 0; k < 3; ++k)
      frames.counts(i, k) = shown(k, mean, modulation, phase, place) + normal(generator);
    frames.mean(i) = mean + 0.6 * normal(generator);
    frames.modulation(i) = 1.02 * modulation + 0.8 * normal(generator);
    // Noise of the coarser phase, and its harmonics.
    frames.phase_rad(i) = phase + 0.15 * normal(generator) + 0.3 * std::sin(6.0 * place);
  }
  return explain_predicted_frames(frames, three_steps(), noise);
}

std::string named(const Shown& shown) {
  const FrameExplanation found = explained(shown);
  EXPECT_TRUE(found.decided);
  return found.has_fault() ? found.explanation.best.front() : "";
}

TEST(ExplainPredictedFrames, BlamesNoSoundFrames) {
  EXPECT_EQ(
      named([](int k, double a, double b, double phase, double) { return fringe(k, a, b, phase); }),
      "");
  for (const double gamma : {1.5, 2.2}) {
    EXPECT_EQ(named([&](int k, double a, double b, double phase, double) {
                const double level = 0.5 + 0.5 * std::cos(phase + kTwoPi * k / 3.0);
                // Mean and amplitude of the light of a power law.
                const double mean =
                    std::tgamma(gamma + 0.5) / (std::sqrt(kPi) * std::tgamma(gamma + 1.0));
                const double amplitude = mean * 2.0 * gamma / (gamma + 1.0);
                return a + b * (std::pow(level, gamma) - mean) / amplitude;
              }),
              "");
  }
  EXPECT_EQ(named([](int k, double a, double b, double phase, double) {
              return (1.0 + 0.04 * (k - 1)) * fringe(k, a, b, phase);  // flicker
            }),
            "");
}

TEST(ExplainPredictedFrames, NamesAFrameAtAnotherGain) {
  const std::string found = named([](int k, double a, double b, double phase, double) {
    return (k == 1 ? 0.5 : 1.0) * fringe(k, a, b, phase);
  });
  EXPECT_EQ(found, "frame 1 has 0.50 times the light");
}

TEST(ExplainPredictedFrames, NamesAFrameThatShowsNoFringes) {
  const auto lost = [](const std::function<double(double, double, double)>& instead) {
    return named([&](int k, double a, double b, double phase, double place) {
      return k == 2 ? instead(a, b, place) : fringe(k, a, b, phase);
    });
  };
  EXPECT_EQ(lost([](double a, double b, double) { return a + b; }), "frame 2 shows no fringes");
  EXPECT_EQ(lost([](double a, double, double) { return a; }), "frame 2 shows no fringes");
  EXPECT_EQ(
      lost([](double a, double, double place) { return a * (1.0 + 0.5 * std::sin(40.0 * place)); }),
      "frame 2 shows no fringes");
}

TEST(ExplainPredictedFrames, NamesALampThatLitOneFrame) {
  const std::string found = named([](int k, double a, double b, double phase, double) {
    return fringe(k, a, b, phase) + (k == 2 ? 25.0 : 0.0);
  });
  EXPECT_EQ(found, "another lamp lit frame 2 alone");
}

TEST(ExplainPredictedFrames, NamesARepeatedFrame) {
  const std::string found = named([](int k, double a, double b, double phase, double) {
    return fringe(k == 1 ? 0 : k, a, b, phase);
  });
  EXPECT_EQ(found, "frame 1 repeats frame 0");
}

TEST(ExplainPredictedFrames, NamesStepsThatAreOff) {
  const std::string found = named([](int k, double a, double b, double phase, double) {
    return fringe(k, a, b, phase + (k == 1 ? 0.25 : 0.0));
  });
  EXPECT_NE(found.find("the shifts differ from those of scan.toml"), std::string::npos) << found;
}

}  // namespace
}  // namespace frangia
