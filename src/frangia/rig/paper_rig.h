#pragma once

#include "frangia/rig/rig.h"

namespace frangia {

/// The 1997 setup in the paper's own quantities (its Fig. 2): x along the viewing direction, y to
/// the side. The axes of the projector and the camera intersect at O at the angle theta0.
struct PaperGeometry {
  double focal_mm = 12.5;    ///< f
  double pixel_mm = 0.0125;  ///< y_pxl
  int columns = 512;         ///< ncol
  int rows = 512;            ///< nrow
  double x0_mm = 490.0;      ///< distance from the camera to O
  double xp_mm = -449.6926;  ///< projector position along x; the default lies 1000 mm from O
  double theta0_rad = 0.3490658503988659;  ///< 20 degrees
  double field_rad = 0.41887902047863906;  ///< illuminated range of psi, centred on 0; 24 degrees

  /// Returns the projector position along y, for which its axis passes through O.
  [[nodiscard]] double yp_mm() const;
};

/// Converts the paper's geometry to a rig without a turntable. The laser sheet is the fringe
/// through O.
///
/// @errors   Error(Input) when a length or theta0 is not above 0
/// @source   the paper's equations (2), (3) and (5)
[[nodiscard]] Rig make_paper_rig(const PaperGeometry& geometry);

}  // namespace frangia
