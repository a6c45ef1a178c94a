#include "frangia/acquisition/internal/room_light.h"

#include <array>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

/// Exposures of half a period more than whole ones, of both frequencies nearly, and of whole
/// periods of 100 and of 120 Hz alone.
struct Exposures {
  double odd_ms;
  std::array<double, 2> even_ms;
};
constexpr Exposures kShort{5.0, {10.0, 1000.0 / 120.0}};
/// In a dim picture short exposures have no counts that could flicker.
constexpr Exposures kLong{45.0, {40.0, 5000.0 / 120.0}};

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
  const Eigen::VectorXd left = light - product(line, least_squares(line, light).col(0));
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
                             double exposure_ms) {
  constexpr double kLeast = 0.001;  // of the full light: below the noise of 8 bits
  constexpr std::array<double, 2> kMains_hz{50.0, 60.0};
  constexpr double kClear = 4.0;  // times what exposures of whole periods leave
  const Exposures exposures = exposure_ms >= kLong.odd_ms ? kLong : kShort;
  const double scatter = scatter_of(probe, lit, exposures.odd_ms);
  std::array<double, 2> left{};
  for (std::size_t i = 0; i < kMains_hz.size(); ++i)
    left[i] = scatter_of(probe, lit, exposures.even_ms[i]);
  const std::size_t best = left[0] <= left[1] ? 0 : 1;
  const double light_hz = 2.0 * kMains_hz[best];
  const double odd_left = flicker_left(exposures.odd_ms, light_hz);
  RoomLight room;
  room.amplitude = std::sqrt(2.0) * scatter / odd_left / full_light;
  room.flickers = scatter > kClear * left[best] && room.amplitude > kLeast;
  if (!room.flickers) return {};
  // The other exposure leaves what a sine of this frequency leaves of it.
  const double expected = flicker_left(exposures.even_ms[1 - best], light_hz) / odd_left;
  const double ratio = left[1 - best] / scatter;
  if (ratio > 0.5 * expected && ratio < 2.0 * expected) room.mains_hz = kMains_hz[best];
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
