#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

enum class HoleFill {
  Flat,   ///< triangles between the corners of the boundary alone
  Smooth  ///< as dense as the surface around, and curved on as it is
};

struct FillHolesOptions {
  double up_to_mm = std::numeric_limits<double>::infinity();  ///< a loop's size_mm, at most
  HoleFill kind = HoleFill::Smooth;
  std::vector<std::size_t> only;  ///< numbers of boundary_loops to fill; empty: all up to the size
};

/// The mesh with holes filled. All that is put in is marked as invented, and has no views.
///
/// A smooth filling that would cross itself, another one or the mesh gives way to one with half of
/// the curvature, to a film of least area, or to a flat one, whichever crosses least: a note of
/// `run` says so, a warning where all cross, and a build without CGAL does not see it. One that
/// would go far out of its bounds gives way to a film. A hole
/// that cannot be filled smoothly is closed flat; one whose flat filling would make the mesh
/// non-manifold gets a fan about its middle: a note of `run` says so.
/// errors   Error(Input) when there is no such loop
/// source   Liepa 2003, Filling Holes in Meshes; fair_patch.h
[[nodiscard]] Mesh fill_holes(Mesh mesh, const FillHolesOptions& options = {}, const Run& run = {});

}  // namespace frangia
