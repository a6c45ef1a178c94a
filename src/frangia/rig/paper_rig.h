#pragma once

#include "frangia/rig/rig.h"

namespace frangia {

/// The 1997 set-up in the paper's own quantities (its Fig. 2): x along the view, y to the side, the
/// projector's and the camera's axes crossing at O under theta0.
struct PaperGeometry {
  double focal_mm = 12.5;    ///< f
  double pixel_mm = 0.0125;  ///< y_pxl
  int columns = 512;         ///< ncol
  int rows = 512;
  double x0_mm = 490.0;      ///< from the camera to O
  double xp_mm = -449.6926;  ///< the projector's place along the view; here 1000 mm from O
  double theta0_rad = 0.3490658503988659;  ///< 20 degrees
  double field_rad = 0.41887902047863906;  ///< lit range of psi, 24 degrees, half to either side

  /// The projector's place to the side, from its axis passing through O.
  [[nodiscard]] double yp_mm() const;
};

/// The same as a rig. The light plane is the fringe through O. Without a turntable.
///
/// errors   Error(Input) when a length or theta0 is not above 0
/// source   the paper's equations (2), (3) and (5)
[[nodiscard]] Rig make_paper_rig(const PaperGeometry& geometry);

}  // namespace frangia
