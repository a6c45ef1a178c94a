#pragma once

#include <cmath>
#include <cstddef>

#include "frangia/inspect/surface_patches.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia::inspect {

/// Guard bands of "out" for noise, which is independent from patch to patch, and for the
/// systematic part, which changes slowly over the part.
struct OutGuard {
  std::size_t independent = 1;
  double together = kGuardBand;  ///< times the combined uncertainty
  double noise = kGuardBand;     ///< times the noise, with half of the error probability
  double systematic = kGuardBand;
  bool split = false;  ///< the two parts are counted one by one

  [[nodiscard]] double guard_mm(double noise_mm, double systematic_mm) const {
    if (split) return noise * noise_mm + systematic * systematic_mm;
    return together * std::hypot(noise_mm, systematic_mm);
  }
};

/// The guard bands for which a good part is called out in 5 % of cases at most. Patches overlap:
/// the number of independent ones is the measured area over that of a patch.
[[nodiscard]] OutGuard out_guard_of(const SurfacePatches& patches);

}  // namespace frangia::inspect
