#include "frangia/indirect_light/indirect_phase.h"

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
  out.sigma_rad =
      std::hypot(kOfError * out.error_rad, kOfShare * albedo * std::abs(share.fringes.back()));
  return out;
}

}  // namespace frangia
