#include "frangia/phase/waveform/share_waveforms.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

FittedAlgorithm fit_of(double period_px, double second, double sigma) {
  FittedAlgorithm fit;
  fit.waveform.waveform = {period_px, FringeDirection::Vertical, {second}};
  fit.waveform.sigma = {sigma};
  return fit;
}

TEST(ShareWaveforms, GivesUndeterminedHarmonicsThoseOfTheNearestPeriod) {
  std::vector<FittedAlgorithm> fits = {
      fit_of(1280.0, 0.0, kUnknown), fit_of(160.0, 0.2, 0.001), fit_of(20.0, 0.1, 0.001)};
  share_waveforms(fits);
  EXPECT_EQ(fits[0].waveform.waveform.amplitude(2), 0.2);
  EXPECT_EQ(fits[0].waveform.sigma[0], 0.001);
  EXPECT_EQ(fits[1].waveform.waveform.amplitude(2), 0.2);
  EXPECT_EQ(fits[2].waveform.waveform.amplitude(2), 0.1);
}

TEST(ShareWaveforms, KeepsHarmonicsThatNoPatternDetermines) {
  std::vector<FittedAlgorithm> fits = {fit_of(1280.0, 0.0, kUnknown), fit_of(20.0, 0.03, 0.05)};
  share_waveforms(fits);
  EXPECT_EQ(fits[0].waveform.waveform.amplitude(2), 0.0);
  EXPECT_EQ(fits[1].waveform.waveform.amplitude(2), 0.03);
}

TEST(ShareWaveforms, KeepsTheHarmonicsOfASquareWaveBesideTheSineOfACoarsePattern) {
  std::vector<FittedAlgorithm> fits = {fit_of(1280.0, 0.0, 0.001), fit_of(53.0, 0.1, 0.026)};
  fits[1].waveform.is_square = true;
  share_waveforms(fits);
  EXPECT_EQ(fits[1].waveform.waveform.amplitude(2), 0.1);
  EXPECT_EQ(fits[1].waveform.sigma[0], 0.026);
}

TEST(ShareWaveforms, GivesAFringeThatDoesNotShowFlickerThatOfTheOthers) {
  std::vector<FittedAlgorithm> fits = {
      fit_of(1280.0, 0.0, kUnknown), fit_of(160.0, 0.0, 0.001), fit_of(20.0, 0.0, 0.001)};
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i].shifts_rad = {0.0, 1.5, 3.0, 4.5};
    if (i > 0) fits[i].waveform.offset_sigma = 0.001;
  }
  fits[1].waveform.flicker_error_rad = 0.03;
  fits[2].waveform.flicker_error_rad = 0.01;
  share_waveforms(fits);
  EXPECT_NEAR(fits[0].waveform.flicker_error_rad, std::sqrt(5e-4), 1e-9);
  EXPECT_EQ(fits[2].waveform.flicker_error_rad, 0.01);
}

}  // namespace
}  // namespace frangia
