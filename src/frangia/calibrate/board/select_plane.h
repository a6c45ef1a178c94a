#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// Finds the largest set of sites that lie on one plane, without a calibrated projector: on a
/// plane the projector coordinate of a fringe is a quotient of two linear functions of the ray.
///
/// @shape    one ray (x/z, y/z) and one light for each site; returns one flag each
/// @units    `light`: projector px, or the tangent of psi
/// @missing  a NaN light is on no plane; all flags are false where no five sites agree
/// @source   RANSAC, Fischler & Bolles 1981
[[nodiscard]] std::vector<bool> select_plane(std::span<const Eigen::Vector2d> rays,
                                             std::span<const double> light);

}  // namespace frangia
