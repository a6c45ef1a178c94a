#pragma once

#include <cstddef>
#include <limits>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// When decimation stops: at a number of triangles, at a tolerance, or at the first of both.
struct DecimateOptions {
  std::size_t triangles = 0;  ///< number of triangles to stop at
  /// Limit of the distance between the two surfaces, in both directions.
  double tolerance_mm = std::numeric_limits<double>::infinity();
};

/// Reduces the number of triangles by edge collapses in the order of their quadric error.
///
/// Sharp edges and boundaries are preserved, a manifold mesh stays manifold, and no triangle flips.
/// Quadrics are weighted by 1/sigma^2. A vertex takes the largest sigma, the fewest views and the
/// largest mark of the vertices that it replaces.
///
/// With a tolerance, edges of a fine mesh collapse first while their quadric states less than a
/// fifth of it. Each further collapse is checked against three quarters of it at the vertices of
/// the original and at the corners, edges and centroids of the new triangles. The result is
/// verified against 85 % in both directions, at points a third of the mean edge length of the
/// original mesh apart; where it is beyond, the vertices around stay, and the collapses that do not
/// depend on them are repeated.
///
/// Non-manifold edges are split first, with a warning.
///
/// @units    mm
/// @errors   Error(Input) for a tolerance that is not positive, with neither a number of triangles
///          nor a tolerance, or when neighbouring triangles have opposite orientation;
///          Error(Cancelled)
/// @source   Garland & Heckbert 1997, Surface Simplification Using Quadric Error Metrics
[[nodiscard]] Mesh decimate(Mesh mesh, const DecimateOptions& options, const Run& run = {});

}  // namespace frangia
