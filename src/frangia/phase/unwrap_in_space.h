#pragma once

#include "frangia/phase/join_regions.h"
#include "frangia/phase/phase_map.h"
#include "frangia/phase/split_regions.h"

namespace frangia {

struct SpaceUnwrapOptions {
  SplitOptions split;
  JoinOptions join;
};

/// Phase that is continuous within each region: residues discarded, regions split where a step may
/// hide, each grown along the largest product of modulations, and joined again where that is safe.
///
/// shape    w x h in and out
/// missing  pixels that were missing, and residues
[[nodiscard]] RelativePhase unwrap_in_space(WrappedPhase phase,
                                            const SpaceUnwrapOptions& options = {});

}  // namespace frangia
