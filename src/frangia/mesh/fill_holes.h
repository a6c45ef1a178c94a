#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Shape of the surface that fills a hole.
enum class HoleFill {
  Flat,   ///< triangles between the boundary vertices only
  Smooth  ///< as dense as the surrounding surface, continuing its curvature
};

/// Which holes are filled, and how.
struct FillHolesOptions {
  double up_to_mm = std::numeric_limits<double>::infinity();  ///< limit of BoundaryLoop::size_mm
  HoleFill kind = HoleFill::Smooth;                           ///< shape of the fill
  std::vector<std::size_t> only;  ///< indices into boundary_loops; empty: all loops up to the size
};

/// Fills holes. New vertices and triangles are marked as synthesized and have no views.
///
/// A smooth patch that intersects itself, another patch or the mesh is replaced by the one with the
/// fewest intersections among half the curvature, a minimal surface and a flat patch; a build
/// without CGAL skips this test. A smooth patch that leaves the surroundings of its hole is
/// replaced by a minimal surface, and one that cannot be computed by a flat patch. A flat patch
/// that would make the mesh non-manifold is replaced by a triangle fan around the centroid of the
/// boundary. `run` receives a note for each replacement and a warning when intersections remain.
///
/// Non-manifold edges, at which loops have no end, are split first with a warning, unless holes are
/// chosen by their index.
///
/// @units    mm
/// @errors   Error(Input) when a loop does not exist, or when neighbouring triangles have opposite
///          orientation; Error(Cancelled)
/// @source   Liepa 2003, Filling Holes in Meshes; fair_patch.h
[[nodiscard]] Mesh fill_holes(Mesh mesh, const FillHolesOptions& options = {}, const Run& run = {});

}  // namespace frangia
