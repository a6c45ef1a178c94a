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

/// A linear fit whose largest residual is as small as possible.
struct ChebyshevFit {
  Eigen::VectorXd parameters;  ///< p, which minimizes the largest |A p - b|
  double largest = 0.0;        ///< that largest residual
  bool converged = false;      ///< false: the iterations ended before; p is worse than the best
};

/// Minimizes the largest residual |A p - b|, by the revised simplex method on the dual linear
/// program: each iteration exchanges one of the points that hold the fit for the one with the
/// largest residual.
///
/// @shape    A: m x n with m > n; b: m
/// @source   Cheney 1966, Introduction to Approximation Theory, the exchange method; Bland 1977
[[nodiscard]] ChebyshevFit chebyshev_fit(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace frangia
