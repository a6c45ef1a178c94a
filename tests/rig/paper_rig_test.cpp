#include "frangia/rig/paper_rig.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/range/triangulate.h"

#include "support/linspace.h"

namespace frangia {
namespace {

struct PaperPoint {
  double x_mm;
  double y_mm;
};

/// Equations (2) to (8) as published, except for the sign of (7.2). Phase in degrees, pitch in
/// fringes per degree.
PaperPoint paper_point(const PaperGeometry& g, double column, double phase_deg, double pitch) {
  const double y_ccd = g.pixel_mm * (0.5 * g.columns - column);    // (2)
  const double alpha = std::atan(y_ccd / g.focal_mm);              // (3)
  const double y0 = g.x0_mm * std::tan(alpha);                     // (4)
  const double phi_x = rad_from_deg(phase_deg / (360.0 * pitch));  // (5)
  const double t = std::tan(g.theta0_rad - phi_x);
  const double y1 = (g.x0_mm - g.xp_mm) * t - g.yp_mm();     // (6)
  const double delta_x = (y1 + y0) / (t + std::tan(alpha));  // (8)
  return {g.x0_mm - delta_x, delta_x * t - y1};              // (7)
}

TEST(PaperRig, TriangulationMatchesEquationsTwoToEight) {
  const PaperGeometry geometry;
  const Rig rig = make_paper_rig(geometry);
  const double pitch = 1.3;
  const Pattern pattern{.name = "fringe", .fringes_per_degree = pitch, .shifts_rad = {}};
  const int middle_row = geometry.rows / 2;
  for (int column = 0; column < geometry.columns; column += 37) {
    for (const double phase_deg : testing::linspace(29, -2400.0, 2388.0)) {
      const PaperPoint expected = paper_point(geometry, column, phase_deg, pitch);
      if (expected.x_mm <= 0.0) continue;
      const Eigen::Vector2d ray = rig.reference().model.ray(Eigen::Vector2d(column, middle_row));
      const RayDepth found = intersect_fringe(ray, rad_from_deg(phase_deg), pattern, rig.projector);
      EXPECT_NEAR(found.depth_mm, expected.x_mm, 1e-9 * std::abs(expected.x_mm));
      EXPECT_NEAR(-found.depth_mm * ray.x(), expected.y_mm, 1e-9 * std::abs(expected.x_mm));
    }
  }
}

TEST(PaperRig, EquationEightAgreesWithTheCameraLine) {
  // y_B = y0 - dX tan(alpha), which the sign error in the published (7.2) violates.
  const PaperGeometry geometry;
  const PaperPoint point = paper_point(geometry, 100.0, 500.0, 1.0);
  const double tan_alpha = geometry.pixel_mm * (256.0 - 100.0) / geometry.focal_mm;
  EXPECT_NEAR(point.y_mm, point.x_mm * tan_alpha, 1e-9);
}

TEST(PaperRig, TheFringeThroughTheAxisPassesThroughO) {
  const PaperGeometry geometry;
  const Rig rig = make_paper_rig(geometry);
  const Pattern pattern{.name = "fringe", .fringes_per_degree = 1.0, .shifts_rad = {}};
  const Eigen::Vector3d o(0.0, 0.0, geometry.x0_mm);
  EXPECT_NEAR(phase_at(o, pattern, rig.projector), 0.0, 1e-12);
  EXPECT_NEAR(rig.laser_sheet->normal.dot(o), rig.laser_sheet->offset_mm, 1e-9);
}

TEST(PaperRig, RefusesAProjectorWithoutAnAngle) {
  EXPECT_THROW(static_cast<void>(make_paper_rig({.theta0_rad = 0.0})), Error);
}

}  // namespace
}  // namespace frangia
