#include "frangia/rig/paper_rig.h"

#include <cmath>

#include "frangia/core/error.h"

namespace frangia {

double PaperGeometry::yp_mm() const {
  return (x0_mm - xp_mm) * std::tan(theta0_rad);
}

Rig make_paper_rig(const PaperGeometry& g) {
  require(g.focal_mm > 0.0 && g.pixel_mm > 0.0 && g.columns > 0 && g.rows > 0 && g.x0_mm > 0.0,
          "make_paper_rig: focal length, pixel, image size and x0 must be above 0");
  require(g.theta0_rad > 0.0 && g.x0_mm > g.xp_mm,
          "make_paper_rig: theta0 must be above 0 and the projector in front of O");
  Rig rig;
  CameraModel& model = rig.reference().model;
  model.width_px = g.columns;
  model.height_px = g.rows;
  model.focal_px.setConstant(g.focal_mm / g.pixel_mm);
  // Equation (2) counts pixels from ncol / 2. The paper's y points left and is -x of the rig frame.
  model.principal_point_px = {0.5 * g.columns, 0.5 * g.rows};
  const double c = std::cos(g.theta0_rad);
  const double s = std::sin(g.theta0_rad);
  rig.projector.model = AngularModel{-0.5 * g.field_rad, 0.5 * g.field_rad};
  rig.projector.position_mm = {-g.yp_mm(), 0.0, g.xp_mm};
  // By equation (6) the ray of psi leaves at theta0 - psi, so psi increases towards the paper's +y.
  rig.projector.rotation << -c, 0.0, s,  //
      0.0, -1.0, 0.0,                    //
      s, 0.0, c;
  const Eigen::Vector3d normal(c, 0.0, -s);
  rig.laser_sheet = LaserSheet{normal, normal.dot(rig.projector.position_mm)};
  return rig;
}

}  // namespace frangia
