#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Settings of a scan: setups, stations, patterns and exposure.
struct ScanRecipe {
  /// Tilts of the part about the x axis, one for each setup; the first is 0, as the model stands.
  std::vector<double> tilts_rad{0.0};
  int stations = 8;                ///< of the turntable in each setup, evenly over one turn
  int shifts = 4;                  ///< frames of each fringe pattern
  std::vector<double> periods_px;  ///< of a digital projector; empty: the usual ones
  /// Longest exposure over the one that is right for white; above 1 a second one, of 1, goes with
  /// it.
  double exposure = 1.0;

  /// The patterns that a rig shows.
  ///
  /// @errors   Error(Input) as default_patterns
  [[nodiscard]] std::vector<Pattern> patterns(const Rig& rig) const;
  /// Frames that the camera takes.
  [[nodiscard]] std::size_t frames(const Rig& rig) const;
  /// "2 setups (0, 180 degrees), 12 stations, periods 1280, 160, 20 px, 4 shifts".
  [[nodiscard]] std::string text() const;
};

}  // namespace frangia
