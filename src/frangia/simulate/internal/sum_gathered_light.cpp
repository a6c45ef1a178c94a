#include "frangia/simulate/internal/sum_gathered_light.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "frangia/core/angles.h"
#include "frangia/simulate/internal/projected_light.h"

namespace frangia {
namespace {

/// Mean of a fringe over an extent, relative to its amplitude.
double mean_over(double extent_rad) {
  const double half = 0.5 * extent_rad;
  return std::abs(half) < 1e-4 ? 1.0 : std::sin(half) / half;
}

}  // namespace

GatheredLightSum::GatheredLightSum(const Pattern& pattern,
                                   const std::vector<Shot>& shots,
                                   const SimulatedScene& scene)
    : pattern_(pattern),
      shots_(shots),
      scene_(scene),
      is_fringe_(pattern.kind == PatternKind::Fringe && shots.front().picture == nullptr) {
  if (!is_fringe_) return;
  constexpr int kPhases = 64;
  for (int i = 0; i < kPhases; ++i) {
    const double phase = kTwoPi * i / kPhases;
    const auto fringe = std::polar(1.0, phase);
    const double shown = shown_fringe(fringe, pattern.period_px, scene);
    for (std::size_t h = 0; h < kHarmonics; ++h) {
      amplitudes_[h] +=
          (h == 0 ? 1.0 : 2.0) / kPhases * shown * std::cos(static_cast<double>(h) * phase);
    }
  }
}

void GatheredLightSum::add_to(std::vector<double>& light,
                              std::span<const GatheredLight> cells) const {
  if (cells.empty()) return;
  if (is_fringe_) {
    add_fringes(light, cells);
    return;
  }
  for (const GatheredLight& cell : cells) {
    const double reflected = scene_.exposure * static_cast<double>(cell.diffuse);
    if (pattern_.kind == PatternKind::Line) {
      const double peak = (1.0 + scene_.options.contrast) * shots_.front().projector;
      light[0] +=
          reflected * peak * std::max(static_cast<double>(cell.line), scene_.options.line_spill);
      continue;
    }
    for (std::size_t i = 0; i < light.size(); ++i) {
      light[i] +=
          shots_[i].projector * reflected *
          frame_light(pattern_, static_cast<int>(i), cell.at.cast<double>(), shots_[i], scene_);
    }
  }
}

void GatheredLightSum::add_fringes(std::vector<double>& light,
                                   std::span<const GatheredLight> cells) const {
  std::array<std::complex<double>, kHarmonics> sums{};
  for (const GatheredLight& cell : cells) {
    const auto weight = static_cast<double>(cell.diffuse);
    const double phase = phase_at(pattern_, cell.at.cast<double>());
    const double side0 = phase_at(pattern_, cell.side[0].cast<double>());
    const double side1 = phase_at(pattern_, cell.side[1].cast<double>());
    sums[0] += weight;
    for (std::size_t h = 1; h < kHarmonics; ++h) {
      if (std::abs(amplitudes_[h]) < 1e-12) continue;
      const auto order = static_cast<double>(h);
      sums[h] += weight * mean_over(order * side0) * mean_over(order * side1) *
                 std::polar(1.0, order * phase);
    }
  }
  for (std::size_t i = 0; i < light.size(); ++i) {
    const std::complex<double> shift(shots_[i].cos_shift, shots_[i].sin_shift);
    std::complex<double> turn = 1.0;
    double shown = 0.0;
    for (std::size_t h = 0; h < kHarmonics; ++h) {
      shown += amplitudes_[h] * (sums[h] * turn).real();
      turn *= shift;
    }
    light[i] += shots_[i].projector * scene_.exposure * shown;
  }
}

}  // namespace frangia
