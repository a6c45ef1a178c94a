#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/inspect/section_curves.h"

namespace frangia {

/// The profile of a blade in a section. Its leading edge is the one with the larger radius.
struct BladeSection {
  double chord_mm = 0.0;            ///< largest distance between two points of the profile
  double max_thickness_mm = 0.0;    ///< diameter of the largest inscribed circle
  double leading_radius_mm = 0.0;   ///< of a circle fitted to the leading edge
  double trailing_radius_mm = 0.0;  ///< of a circle fitted to the trailing edge
  double stagger_rad = 0.0;         ///< of the chord from `u` towards `v`, -pi/2 to pi/2
  Eigen::Vector2d leading_mm = Eigen::Vector2d::Zero();   ///< leading end of the chord
  Eigen::Vector2d trailing_mm = Eigen::Vector2d::Zero();  ///< trailing end of the chord
  std::vector<Eigen::Vector2d> camber_mm;  ///< centers of inscribed circles, from the leading edge
  double max_camber_mm = 0.0;              ///< largest distance of the camber line from the chord
};

/// Measures a closed profile. The camber line consists of the centers of circles that touch both
/// sides. The circles of the edges are fitted to the points within 0.9 radii of each end of the
/// chord, along the curve.
///
/// @units    mm, rad
/// @errors   Error(Input) when the curve is open, has fewer than 32 points, or is no slender
/// profile
/// @source   inscribed circles: Blum 1967; circle of least squares: Kåsa 1976, then Gauss-Newton
[[nodiscard]] BladeSection measure_blade_section(const SectionCurve& curve);

}  // namespace frangia
