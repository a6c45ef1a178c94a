#pragma once

#include <string>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

struct PatternPlan {
  double fringes_per_degree = 1.0;  ///< angular projector: of the finest pattern
  std::vector<double> periods_px;   ///< pinhole projector; empty: the width, its 8th and its 64th
  /// Instead of the above, a sequence of `fringe_sequence` that ends with `fringes` over the field.
  std::string sequence;
  /// "gray": the finest fringes alone, numbered by Gray code.
  double fringes = 64.0;
  int shifts = 4;                    ///< frames a fringe pattern, evenly over a turn
  bool inverted = true;              ///< Gray code: each frame again, inverted
  std::vector<double> exposures_ms;  ///< of fringes and Gray code; empty: one, not told
  int ramp = 0;                      ///< levels of a grey ramp shown as well; 0 for none
};

/// Patterns that give a rig absolute phase.
///
/// angular with a laser sheet   one fringe pattern, and the line that numbers its fringes
/// angular without                 from one fringe over the field, doubled up to the finest
/// pinhole                         the periods, from coarse to fine
///
/// errors   Error(Input) for fewer than three shifts, or a period or pitch that is not above 0
[[nodiscard]] std::vector<Pattern> default_patterns(const Rig& rig, const PatternPlan& plan = {});

}  // namespace frangia
