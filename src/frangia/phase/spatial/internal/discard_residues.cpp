#include "frangia/phase/spatial/internal/discard_residues.h"

#include "frangia/core/missing.h"
#include "frangia/phase/spatial/find_residues.h"

namespace frangia {

std::size_t discard_residues(WrappedPhase& phase) {
  std::size_t discarded = 0;
  for (const Residue& residue : find_residues(phase.phase_rad)) {
    for (int corner = 0; corner < 4; ++corner) {
      const int x = residue.x + corner % 2;
      const int y = residue.y + corner / 2;
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      phase.status(x, y) = PixelStatus::Residue;
      phase.phase_rad(x, y) = kMissing;
      phase.sigma_rad(x, y) = kMissing;
      if (!phase.systematic_rad.empty()) phase.systematic_rad(x, y) = kMissing;
      ++discarded;
    }
  }
  return discarded;
}

}  // namespace frangia
