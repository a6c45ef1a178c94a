#include "frangia/acquisition/internal/room_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/QR>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// Standard deviation of the light of frames at scattered times, counts a ms; light that becomes
/// brighter or darker evenly has none.
double scatter_of(DisplayProbe& probe, const LitPixels& lit, double exposure_ms) {
  constexpr std::size_t kFrames = 24;
  constexpr double kGolden = 0.6180339887498949;  // scatters the times evenly
  constexpr double kSpread_s = 0.05;              // whole periods of 100 and of 120 Hz
  const Pattern flash = dark_and_bright();
  probe.expose_for(exposure_ms);
  Eigen::MatrixXd line(kFrames, 2);
  Eigen::VectorXd light(kFrames);
  for (std::size_t i = 0; i < kFrames + kMostUnderWay; ++i) {
    const double at = kGolden * static_cast<double>(i);
    probe.set_delay(kSpread_s * (1.0 + at - std::floor(at)));
    const double mean = lit.mean_of(probe.take(flash, 0).frame) / exposure_ms;
    if (i < kMostUnderWay) continue;  // exposed before
    const auto row = static_cast<Eigen::Index>(i - kMostUnderWay);
    line.row(row) << 1.0, static_cast<double>(row);
    light(row) = mean;
  }
  const Eigen::VectorXd left = light - line * line.householderQr().solve(light);
  return left.norm() / std::sqrt(static_cast<double>(kFrames - 2));
}

}  // namespace

double flicker_left(double exposure_ms, double light_hz) {
  const double half = kPi * light_hz * 1e-3 * exposure_ms;
  return half == 0.0 ? 1.0 : std::abs(std::sin(half) / half);
}

RoomLight measure_room_light(DisplayProbe& probe,
                             const LitPixels& lit,
                             double full_light,
                             const CameraInfo& camera) {
  constexpr double kLeast = 0.001;  // of the full light: below the noise of 8 bits
  constexpr double kShort_ms = 4.0;
  constexpr std::array<double, 2> kMains_hz{50.0, 60.0};
  constexpr double kClear = 4.0;  // times what exposures of whole periods leave
  const double short_ms = std::clamp(kShort_ms, camera.min_exposure_ms, camera.max_exposure_ms);
  const double scatter = scatter_of(probe, lit, short_ms);
  std::array<double, 2> left{};
  for (std::size_t i = 0; i < kMains_hz.size(); ++i)
    left[i] = scatter_of(probe, lit, 1000.0 / (2.0 * kMains_hz[i]));
  const std::size_t best = left[0] <= left[1] ? 0 : 1;
  RoomLight room;
  room.flickers = scatter > kClear * left[best] && scatter > kLeast * full_light;
  if (!room.flickers) return room;
  // The other exposure leaves what a sine of this frequency leaves of it.
  const double light_hz = 2.0 * kMains_hz[best];
  const double expected = flicker_left(1000.0 / (2.0 * kMains_hz[1 - best]), light_hz) /
                          flicker_left(short_ms, light_hz);
  const double ratio = left[1 - best] / scatter;
  if (ratio > 0.5 * expected && ratio < 2.0 * expected) room.mains_hz = kMains_hz[best];
  room.amplitude = std::sqrt(2.0) * scatter / flicker_left(short_ms, light_hz) / full_light;
  return room;
}

double common_period_ms(double refresh_ms, double room_ms) {
  constexpr int kMost = 6;
  constexpr double kAgree = 0.01;
  if (refresh_ms <= 0.0) return room_ms;
  if (room_ms <= 0.0) return refresh_ms;
  for (int i = 1; i <= kMost; ++i) {
    const double periods = i * refresh_ms / room_ms;
    if (std::round(periods) >= 1.0 && std::abs(periods / std::round(periods) - 1.0) < kAgree)
      return i * refresh_ms;
  }
  return refresh_ms;
}

}  // namespace frangia
