#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/features/shape.h"

namespace frangia {

/// Which parameters of a shape a minimum zone may choose.
enum class ZoneFreedom {
  All,     ///< all: flatness, cylindricity
  Section  ///< center across the axis, and radius: roundness of a section
};

/// The width of the narrowest zone between two parallel shapes that contains all points: planes,
/// concentric spheres, coaxial cylinders or cones; in a section, concentric circles.
///
/// `start` is the least-squares shape. Chebyshev fits to the linearized distances are repeated
/// until the width stops to fall, which is the exact zone near the start. It is never wider than
/// the zone of the start.
///
/// @units    mm
/// @errors   Error(Input) for a line, a circle or a torus
/// @source   ISO 1101:2017, minimum requirement; ISO 12781-1, ISO 12181-1, ISO 12180-1
[[nodiscard]] double minimum_zone_width(const Shape& start,
                                        const std::vector<Eigen::Vector3d>& points_mm,
                                        ZoneFreedom freedom);

}  // namespace frangia
