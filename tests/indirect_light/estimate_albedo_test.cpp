#include "frangia/indirect_light/estimate_albedo.h"

#include <cmath>
#include <complex>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

const std::vector<Pattern> kFine = {{.name = "fine", .period_px = 20.0}};

/// Pixels of a projector of contrast 0.9, of which each second one sees lit surface. `albedo_at`
/// gives the reflectance that made the light of a sample.
template <typename Albedo>
std::vector<AlbedoSample> samples_of(const Albedo& albedo_at) {
  constexpr std::size_t kCount = 1600;
  constexpr double kContrast = 0.9;
  constexpr double kSigma = 0.01;
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, kSigma);
  std::vector<AlbedoSample> out;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double seen = i % 2 == 0 ? 0.0 : 0.1 + 0.4 * static_cast<double>(i % 7) / 7.0;
    AlbedoSample sample;
    sample.predicted.mean = seen;
    sample.predicted.fringes = {std::polar(0.1 * seen, 0.4 * static_cast<double>(i))};
    const double albedo = albedo_at(i, kCount);
    const double modulation = std::abs(1.0 + albedo * sample.predicted.fringes[0]);
    const double inverse = (1.0 + albedo * seen) / (kContrast * modulation);
    sample.measured = {{static_cast<float>(inverse * (1.0 + noise(generator))),
                        0.01F,
                        static_cast<float>(kSigma),
                        0.0F}};
    out.push_back(sample);
  }
  return out;
}

TEST(EstimateAlbedo, FindsTheReflectanceThatMadeTheFrames) {
  const AlbedoEstimate found =
      estimate_albedo(samples_of([](std::size_t, std::size_t) { return 0.6; }), kFine);
  EXPECT_TRUE(found.significant);
  EXPECT_NEAR(found.albedo, 0.6, 0.05);
}

TEST(EstimateAlbedo, HasNoResultAtItsBound) {
  const AlbedoEstimate found =
      estimate_albedo(samples_of([](std::size_t, std::size_t) { return 1.6; }), kFine);
  EXPECT_FALSE(found.significant);
  EXPECT_EQ(found.albedo, 0.0);
}

TEST(EstimateAlbedo, HasNoResultThatDoesNotPredictSamplesItWasNotFittedTo) {
  // Something else lowers the contrast in every second block of the image.
  const AlbedoEstimate found = estimate_albedo(samples_of([](std::size_t i, std::size_t count) {
                                                 return i * 8 / count % 2 == 0 ? 0.15 : 0.0;
                                               }),
                                               kFine);
  EXPECT_GT(found.improvement, 0.2);
  EXPECT_FALSE(found.significant);
}

TEST(EstimateAlbedo, FindsNoneWithoutIndirectLight) {
  const AlbedoEstimate found =
      estimate_albedo(samples_of([](std::size_t, std::size_t) { return 0.0; }), kFine);
  EXPECT_FALSE(found.significant);
}

}  // namespace
}  // namespace frangia
