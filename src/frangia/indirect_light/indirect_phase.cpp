#include "frangia/indirect_light/indirect_phase.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "frangia/core/angles.h"

namespace frangia {

IndirectPhase indirect_phase(const IndirectShare& share,
                             double albedo,
                             std::span<const Pattern> patterns,
                             PhaseSource source) {
  constexpr double kOfError = 1.0;
  constexpr double kOfShare = 0.5;
  constexpr double kMostDifference_rad = 0.75 * kPi;  // of one level from the next
  IndirectPhase out;
  double slope = 0.0;
  double weights = 0.0;
  double coarser = 0.0;  // error of the level before
  for (std::size_t m = 0; m < patterns.size(); ++m) {
    const double ratio = patterns[m].fringes_per_unit() / patterns.back().fringes_per_unit();
    out.error_rad = std::arg(1.0 + albedo * share.fringes[m]);
    slope += ratio * out.error_rad;
    weights += ratio * ratio;
    if (m > 0 && source == PhaseSource::Finest) {
      const double finer = patterns[m].fringes_per_unit() / patterns[m - 1].fringes_per_unit();
      out.wrong_order =
          out.wrong_order || std::abs(finer * coarser - out.error_rad) > kMostDifference_rad;
    }
    coarser = out.error_rad;
  }
  if (source == PhaseSource::Slope) out.error_rad = slope / weights;
  const double fringes = std::abs(share.fringes.back());
  // Fringes of unmeasured surface average out as those of the measured one do.
  const double coherence = share.mean > 0.05 ? std::min(1.0, fringes / share.mean) : 0.5;
  const double unknown = std::min(1.0, albedo * share.unknown * coherence);
  out.sigma_rad = std::hypot(kOfError * out.error_rad, kOfShare * albedo * fringes, unknown);
  return out;
}

SolvedPhase direct_phase(const IndirectShare& share,
                         double assumed_rad,
                         double measured_rad,
                         double albedo,
                         std::span<const Pattern> patterns,
                         PhaseSource source) {
  constexpr int kIterations = 20;
  const auto at_phase = [&](double phase_rad) {
    IndirectShare turned = share;
    for (std::size_t m = 0; m < patterns.size(); ++m) {
      const double ratio = patterns[m].fringes_per_unit() / patterns.back().fringes_per_unit();
      turned.fringes[m] *= std::polar(1.0, ratio * (assumed_rad - phase_rad));
    }
    return indirect_phase(turned, albedo, patterns, source);
  };
  // Direct light that is the stronger makes the measured phase rise with the direct one.
  double low = measured_rad - 0.5 * kPi;
  double high = measured_rad + 0.5 * kPi;
  for (int i = 0; i < kIterations; ++i) {
    const double middle = 0.5 * (low + high);
    (middle + at_phase(middle).error_rad < measured_rad ? low : high) = middle;
  }
  const double solved = 0.5 * (low + high);
  return {solved, at_phase(solved).wrong_order};
}

}  // namespace frangia
