#include "frangia/rig/fringe_waveform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "frangia/core/error.h"

namespace frangia {

double FringeWaveform::light_at(double phase_rad) const {
  double light = std::cos(phase_rad);
  for (std::size_t i = 0; i < harmonics.size(); ++i)
    light += (harmonics[i] * std::polar(1.0, static_cast<double>(i + 2) * phase_rad)).real();
  return light;
}

double FringeWaveform::amplitude(int order) const {
  const auto i = static_cast<std::size_t>(order - 2);
  return order < 2 || i >= harmonics.size() ? 0.0 : std::abs(harmonics[i]);
}

const FringeWaveform* find_waveform(const std::vector<FringeWaveform>& waveforms,
                                    const Pattern& pattern) {
  const FringeWaveform* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const FringeWaveform& waveform : waveforms) {
    if (waveform.direction != pattern.direction) continue;
    const bool comparable = waveform.period_px > 0.0 && pattern.period_px > 0.0;
    const double apart =
        comparable ? std::abs(std::log(waveform.period_px / pattern.period_px)) : 0.0;
    if (nearest != nullptr && apart >= least) continue;
    nearest = &waveform;
    least = apart;
  }
  return nearest;
}

namespace {

/// Samples of a curve. Linear interpolation of a gamma of 2.2 is then accurate to 1e-4 of full
/// light.
constexpr std::size_t kSamples = 65;

/// Replaces falling sequences by their mean (pool adjacent violators).
void make_monotone(std::vector<double>& values) {
  struct Pool {
    double sum;
    double count;
  };
  std::vector<Pool> pools;
  for (const double value : values) {
    Pool last{value, 1.0};
    while (!pools.empty() && pools.back().sum / pools.back().count >= last.sum / last.count) {
      last = {last.sum + pools.back().sum, last.count + pools.back().count};
      pools.pop_back();
    }
    pools.push_back(last);
  }
  auto next = values.begin();
  for (const Pool& pool : pools)
    next = std::fill_n(next, static_cast<std::ptrdiff_t>(pool.count), pool.sum / pool.count);
}

/// Slopes of the monotone cubic interpolant: harmonic means of the chord slopes (Fritsch and
/// Carlson 1980; Fritsch and Butland 1984).
std::vector<double> slopes_of(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> chord(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i)
    chord[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  std::vector<double> slope(n);
  slope.front() = chord.front();
  slope.back() = chord.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double product = chord[i - 1] * chord[i];
    slope[i] = product > 0.0 ? 2.0 * product / (chord[i - 1] + chord[i]) : 0.0;
  }
  return slope;
}

}  // namespace

double ResponseCurve::light_of(double level) const {
  const double position = std::clamp(level, 0.0, 1.0) * static_cast<double>(light.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(position), light.size() - 2);
  return std::lerp(light[i], light[i + 1], position - static_cast<double>(i));
}

double ResponseCurve::level_of(double light_fraction) const {
  const double wanted = std::clamp(light_fraction, 0.0, 1.0);
  const auto above = std::lower_bound(light.begin() + 1, light.end() - 1, wanted);
  const auto i = static_cast<std::size_t>(above - light.begin()) - 1;
  const double rise = light[i + 1] - light[i];
  const double within = rise > 0.0 ? std::clamp((wanted - light[i]) / rise, 0.0, 1.0) : 1.0;
  return (static_cast<double>(i) + within) / static_cast<double>(light.size() - 1);
}

ResponseCurve make_response_curve(const std::vector<double>& levels, std::vector<double> light) {
  require(levels.size() >= 3 && light.size() == levels.size(),
          "a response curve needs at least three levels and one light value per level");
  require(std::is_sorted(levels.begin(), levels.end(), std::less_equal<>()) &&
              levels.front() == 0.0 && levels.back() == 1.0,
          "the levels of a response curve must rise from 0 to 1");
  const double dark = light.front();
  const double full = light.back() - dark;
  require(std::isfinite(full) && full > 0.0,
          "the projector's last level is not brighter than its first; check the projector");
  for (double& value : light)
    value = (value - dark) / full;
  make_monotone(light);
  for (double& value : light)
    value = std::clamp(value, 0.0, 1.0);
  light.front() = 0.0;
  light.back() = 1.0;
  const std::vector<double> slope = slopes_of(levels, light);
  ResponseCurve curve;
  std::size_t i = 0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const double level = static_cast<double>(k) / (kSamples - 1);
    while (i + 2 < levels.size() && level > levels[i + 1])
      ++i;
    const double step = levels[i + 1] - levels[i];
    const double t = (level - levels[i]) / step;
    const double u = 1.0 - t;
    const double cubic = light[i] * u * u * (1.0 + 2.0 * t) + step * slope[i] * t * u * u +
                         light[i + 1] * t * t * (1.0 + 2.0 * u) - step * slope[i + 1] * t * t * u;
    curve.light.push_back(std::clamp(cubic, 0.0, 1.0));
  }
  make_monotone(curve.light);
  curve.light.front() = 0.0;
  curve.light.back() = 1.0;
  return curve;
}

ResponseCurve compose(const ResponseCurve& known, const ResponseCurve& residual) {
  ResponseCurve all;
  for (std::size_t k = 0; k < kSamples; ++k)
    all.light.push_back(residual.light_of(known.light_of(static_cast<double>(k) / (kSamples - 1))));
  return all;
}

}  // namespace frangia
