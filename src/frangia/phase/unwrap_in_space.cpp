#include "frangia/phase/unwrap_in_space.h"

#include <utility>

#include "frangia/phase/discard_residues.h"
#include "frangia/phase/grow_phase.h"
#include "frangia/phase/link_runs.h"

namespace frangia {

RelativePhase unwrap_in_space(WrappedPhase phase, const SpaceUnwrapOptions& options) {
  discard_residues(phase);
  Regions regions = split_regions(phase, options.split);
  RelativePhase relative = options.method == SpaceMethod::Runs
                               ? link_runs(std::move(phase), regions)
                               : grow_phase(phase, regions);
  join_regions(relative, regions, options.join);
  return relative;
}

}  // namespace frangia
