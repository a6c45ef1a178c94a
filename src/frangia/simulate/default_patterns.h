#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The patterns that `default_patterns` creates for a rig.
struct PatternPlan {
  /// Pinhole projector: direction of fringes and Gray code; none: `measuring_direction` of the rig.
  std::optional<FringeDirection> direction;
  double fringes_per_degree = 1.0;  ///< angular projector: pitch of the finest pattern
  /// Pinhole projector; empty: width, width / 8, width / 64, or height for horizontal fringes.
  std::vector<double> periods_px;
  /// Replaces the two above when not empty: a name known to `fringe_sequence`, or "gray" for the
  /// finest fringes alone with a Gray code that gives their order, or "gray-alone" for this code
  /// without the fringes.
  std::string sequence;
  double fringes = 64.0;             ///< over the field, of the sequence's finest pattern
  int shifts = 4;                    ///< frames per fringe pattern, evenly over 2 pi
  bool inverted = true;              ///< Gray code: shows each frame inverted as well
  std::vector<double> exposures_ms;  ///< of fringes and Gray code; empty: the camera's exposure
  int ramp = 0;                      ///< levels of an additional grey ramp; 0 for none
  bool white = false;                ///< adds a frame of full light
  bool dark = false;                 ///< adds a frame without the projector's light
};

/// Returns patterns from which a rig's phase is absolute.
///
/// angular projector, laser sheet      one fringe pattern and the line that fixes its order
/// angular projector, no laser sheet   doubled from at most one fringe over the field to the finest
/// pinhole projector                   the periods, coarse to fine
///
/// @errors   Error(Input) for fewer than 3 shifts, a period below 2 pixels, a pitch that is not
///          above 0 or gives more than 1e6 fringes, or an option that the projector cannot show
[[nodiscard]] std::vector<Pattern> default_patterns(const Rig& rig, const PatternPlan& plan = {});

/// Returns patterns with which a board is captured: those of `default_patterns`, the same fringes
/// in the other direction, and one frame of white light.
///
/// @errors   Error(Input) when the projector is angular, and as `default_patterns`
[[nodiscard]] std::vector<Pattern> calibration_patterns(const Rig& rig,
                                                        const PatternPlan& plan = {});

}  // namespace frangia
