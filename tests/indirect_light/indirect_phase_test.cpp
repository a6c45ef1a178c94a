#include "frangia/indirect_light/indirect_phase.h"

#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/indirect_light/estimate_albedo.h"

namespace frangia {
namespace {

std::vector<Pattern> of_periods(const std::vector<double>& periods_px) {
  std::vector<Pattern> patterns;
  for (const double period : periods_px)
    patterns.push_back({.name = "p", .period_px = period});
  return patterns;
}

IndirectShare share_of(double mean, double unknown, std::vector<std::complex<double>> fringes) {
  IndirectShare share;
  share.mean = mean;
  share.unknown = unknown;
  share.fringes = std::move(fringes);
  return share;
}

TEST(IndirectPhaseSigma, IsTheErrorHalfTheFringesAndWhatIsUnknown) {
  const auto patterns = of_periods({16.0});
  const auto sigma = [&](const IndirectShare& share, double albedo) {
    return indirect_phase(share, albedo, patterns, PhaseSource::Finest).sigma_rad;
  };
  const std::complex<double> fringe = std::polar(0.3, 0.9);
  const double error = std::arg(1.0 + 0.5 * fringe);
  EXPECT_NEAR(sigma(share_of(0.6, 0.0, {fringe}), 0.5), std::hypot(error, 0.5 * 0.5 * 0.3), 1e-12);
  // Unmeasured surface has the coherence of the measured one: 0.3 / 0.6.
  EXPECT_NEAR(sigma(share_of(0.6, 0.2, {fringe}), 0.5),
              std::hypot(error, 0.5 * 0.5 * 0.3, 0.5 * 0.2 * 0.5),
              1e-12);
  EXPECT_NEAR(sigma(share_of(0.2, 0.2, {fringe}), 0.5),
              std::hypot(error, 0.5 * 0.5 * 0.3, 0.5 * 0.2),
              1e-12)
      << "at most all of it";
  EXPECT_NEAR(sigma(share_of(0.04, 0.2, {0.0}), 0.5), 0.5 * 0.2 * 0.5, 1e-12)
      << "half where too little is measured to tell";
  EXPECT_NEAR(sigma(share_of(0.06, 0.2, {0.0}), 0.5), 0.0, 1e-12);
  EXPECT_NEAR(sigma(share_of(0.0, 9.0, {0.0}), 1.0), 1.0, 1e-12) << "at most 1 rad";
}

TEST(IndirectPhaseOrder, IsWrongBeyondThreeQuartersOfHalfATurnFromTheLevelBefore) {
  const auto patterns = of_periods({64.0, 16.0});
  // Errors of e and 0 rad: four times e is compared with 0.75 pi.
  const auto wrong = [&](double error, PhaseSource source) {
    const std::complex<double> fringe = std::polar(1.0, error) / std::cos(error) - 1.0;
    return indirect_phase(share_of(0.5, 0.0, {fringe, 0.0}), 1.0, patterns, source).wrong_order;
  };
  const double limit = 0.75 * kPi / 4.0;
  EXPECT_FALSE(wrong(0.99 * limit, PhaseSource::Finest));
  EXPECT_TRUE(wrong(1.01 * limit, PhaseSource::Finest));
  EXPECT_TRUE(wrong(-1.01 * limit, PhaseSource::Finest));
  EXPECT_FALSE(wrong(1.01 * limit, PhaseSource::Slope));
  // Each level against the one before it.
  const std::complex<double> fringe = std::polar(1.0, 1.01 * limit) / std::cos(limit) - 1.0;
  EXPECT_TRUE(indirect_phase(share_of(0.5, 0.0, {fringe, 0.0, 0.0}),
                             1.0,
                             of_periods({256.0, 64.0, 16.0}),
                             PhaseSource::Finest)
                  .wrong_order);
}

/// Samples whose indirect share rises to one half, without noise.
std::vector<AlbedoSample> exact_samples(double albedo, double sigma_rad, int outliers = 0) {
  const double ratio = 0.25;
  std::vector<AlbedoSample> samples;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double mean = 0.5 * static_cast<double>(i) / 199.0;
    AlbedoSample sample;
    sample.predicted =
        share_of(mean, 0.0, {std::polar(0.7 * mean, 1.1), std::polar(0.3 * mean, -0.4)});
    const double direct = 40.0 + 30.0 * uniform_from(hash(i));
    std::vector<double> errors;
    for (const auto& fringe : sample.predicted.fringes)
      errors.push_back(std::arg(1.0 + albedo * fringe));
    for (std::size_t m = 0; m < 2; ++m) {
      const double modulation = direct * std::abs(1.0 + albedo * sample.predicted.fringes[m]);
      const double all = direct / (m == 0 ? 0.9 : 0.7) * (1.0 + albedo * mean) + 6.0;
      const bool wrong = i < static_cast<std::uint64_t>(outliers);
      sample.measured.push_back({static_cast<float>((wrong ? 2.0 : 1.0) * all / modulation),
                                 static_cast<float>(1.0 / modulation),
                                 static_cast<float>(sigma_rad),
                                 static_cast<float>(m == 0 ? errors[0] - ratio * errors[1] : 0.0)});
    }
    samples.push_back(sample);
  }
  return samples;
}

TEST(EstimateAlbedoExactly, IsTheReflectanceOfExactFramesBetweenItsSteps) {
  const auto patterns = of_periods({64.0, 16.0});
  for (const double albedo : {0.12, 0.4, 0.66, 0.93}) {
    const AlbedoEstimate found = estimate_albedo(exact_samples(albedo, 0.01), patterns);
    EXPECT_TRUE(found.significant);
    EXPECT_NEAR(found.albedo, albedo, 0.006);
    EXPECT_LT(found.unexplained, 0.05);
  }
}

TEST(EstimateAlbedoExactly, BearsOutliers) {
  const AlbedoEstimate found =
      estimate_albedo(exact_samples(0.4, 0.01, 10), of_periods({64.0, 16.0}));
  EXPECT_TRUE(found.significant);
  EXPECT_NEAR(found.albedo, 0.4, 0.05);
}

TEST(EstimateAlbedoExactly, NeedsAnImprovementAboveTheNoise) {
  const auto patterns = of_periods({64.0, 16.0});
  EXPECT_TRUE(estimate_albedo(exact_samples(0.1, 0.01), patterns).significant);
  EXPECT_FALSE(estimate_albedo(exact_samples(0.1, 0.2), patterns).significant);
  EXPECT_FALSE(estimate_albedo(exact_samples(0.0, 0.01), patterns).significant);
}

TEST(EstimateAlbedoExactly, IsNothingWhereNoSampleSeesLitSurface) {
  std::vector<AlbedoSample> samples = exact_samples(0.8, 0.001);
  std::erase_if(samples, [](const AlbedoSample& sample) { return sample.predicted.mean > 0.03; });
  ASSERT_FALSE(samples.empty());
  const AlbedoEstimate found = estimate_albedo(samples, of_periods({64.0, 16.0}));
  EXPECT_FALSE(found.significant);
  EXPECT_EQ(found.improvement, 0.0);
  EXPECT_EQ(found.unexplained, 1.0);
}

TEST(EstimateAlbedoExactly, StatesTheSquaredPhaseResidualsThatItExplains) {
  // One pattern pair whose contrasts tell nothing: the phase residuals alone are e / sigma.
  const double error = std::arg(1.0 + 0.5 * std::polar(0.2, 1.3));
  AlbedoSample sample;
  sample.predicted = share_of(0.1, 0.0, {std::polar(0.2, 1.3), 0.0});
  const auto sigma = static_cast<float>(0.05);
  sample.measured = {{1.0F, 1.0F, sigma, static_cast<float>(error)}, {1.0F, 1.0F, sigma, 0.0F}};
  const std::vector<AlbedoSample> samples(50, sample);
  const AlbedoEstimate found = estimate_albedo(samples, of_periods({64.0, 16.0}));
  EXPECT_TRUE(found.significant);
  EXPECT_NEAR(found.albedo, 0.5, 0.01);
  // The noise of the finest phase counts by a quarter, and the model by 0.004 rad.
  const double of_difference = std::hypot(0.05, 0.25 * 0.05 + 0.004);
  EXPECT_NEAR(found.improvement, std::pow(error / of_difference, 2), 0.02);
  EXPECT_LT(found.unexplained, 0.01);
}

}  // namespace
}  // namespace frangia
