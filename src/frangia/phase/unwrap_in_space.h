#pragma once

#include "frangia/phase/join_regions.h"
#include "frangia/phase/phase_map.h"
#include "frangia/phase/split_regions.h"

namespace frangia {

/// How the pixels of a region are put in order.
enum class SpaceMethod {
  Runs,       ///< runs of rows, see `link_runs`: the fast one
  TakedaAbe,  ///< growth along the largest product of modulations, the paper's, see `grow_phase`
  Herraez     ///< edges sorted by reliability, see `sort_phase`
};

struct SpaceUnwrapOptions {
  SpaceMethod method = SpaceMethod::Runs;
  SplitOptions split;
  JoinOptions join;
  /// Keep the order in which the paper's growth reaches the pixels, to be looked at; where another
  /// method unwraps, it is that of the same regions by the growth.
  bool keep_order = false;
};

/// Phase that is continuous within each region: residues discarded, regions split where a step may
/// hide, each unwrapped, and joined again where that is safe.
///
/// shape    w x h in and out
/// missing  pixels that were missing, and residues
[[nodiscard]] RelativePhase unwrap_in_space(WrappedPhase phase,
                                            const SpaceUnwrapOptions& options = {});

}  // namespace frangia
