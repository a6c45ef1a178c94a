#pragma once

#include <cstddef>
#include <string>

#include "frangia/core/missing.h"
#include "frangia/decode/view_quality.h"

namespace frangia {

/// What one view of a scan measured.
struct ViewSummary {
  std::string name;            ///< folder of the view, as scan.toml gives it
  double angle_rad = 0.0;      ///< commanded turntable angle
  int setup = 0;               ///< number of the setup in scan.toml
  std::size_t points = 0;      ///< measured, before the background is removed
  double sigma_mm = kMissing;  ///< median noise of the points along their rays; NaN without points
  bool left_out = false;       ///< not part of the mesh; a warning gives the reason
  std::string reason{};   ///< why its frames, or parts of them, are not used; empty if they are
  std::string same_as{};  ///< an earlier view with the same phase at every pixel, to the last
                          ///< bit; empty for none
  ViewQuality quality{};  ///< of the frames of the reference camera
};

}  // namespace frangia
