#include "frangia/phase/unwrap_in_space.h"

#include <utility>

#include "frangia/phase/discard_residues.h"
#include "frangia/phase/grow_phase.h"
#include "frangia/phase/link_runs.h"
#include "frangia/phase/sort_phase.h"

namespace frangia {

RelativePhase unwrap_in_space(WrappedPhase phase, const SpaceUnwrapOptions& options) {
  discard_residues(phase);
  Regions regions = split_regions(phase, options.split);
  RelativePhase relative;
  Image<std::int32_t> order;
  if (options.keep_order) order = grow_phase(phase, regions, true).order;
  switch (options.method) {
    case SpaceMethod::Runs:
      relative = link_runs(std::move(phase), regions);
      break;
    case SpaceMethod::TakedaAbe:
      relative = grow_phase(phase, regions);
      break;
    case SpaceMethod::Herraez:
      relative = sort_phase(phase, regions);
      break;
  }
  relative.order = std::move(order);
  join_regions(relative, regions, options.join);
  return relative;
}

}  // namespace frangia
