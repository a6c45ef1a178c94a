#include "frangia/phase/unwrap_in_space.h"

#include "frangia/phase/discard_residues.h"
#include "frangia/phase/grow_phase.h"

namespace frangia {

RelativePhase unwrap_in_space(WrappedPhase phase, const SpaceUnwrapOptions& options) {
  discard_residues(phase);
  const Regions regions = split_regions(phase, options.split);
  RelativePhase relative = grow_phase(phase, regions);
  join_regions(relative, regions, options.join);
  return relative;
}

}  // namespace frangia
