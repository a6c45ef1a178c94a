#pragma once

#include "frangia/phase/phase_map.h"
#include "frangia/phase/split_regions.h"

namespace frangia {

struct JoinOptions {
  /// Two regions are one when this share of the border between them is smooth and asks for the same
  /// whole number of fringes.
  double min_agreement = 0.75;
};

/// Joins regions where that is safe, shifting one by whole fringes, and numbers them from the
/// largest. A border that is partly a step is left: those regions stay apart, never guessed.
void join_regions(RelativePhase& phase, const Regions& regions, const JoinOptions& options = {});

}  // namespace frangia
