#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/mesh/internal/fair_patch.h"
#include "frangia/mesh/internal/patch_mesh.h"

namespace frangia {

/// The target edge length at a vertex of a patch, and its distance from the boundary.
struct PatchSpacing {
  double edge_mm = 0.0;
  double from_boundary_mm = 0.0;
};

/// Refines a patch: first coarsely, to compute its shape, then to the density of the surroundings.
class PatchRefinement {
 public:
  /// `patch` must outlive the object; `spacing` has one element per vertex.
  PatchRefinement(PatchMesh& patch, std::vector<PatchSpacing> spacing);

  /// Splits triangles that are larger than the target at their corners, which grows with the
  /// distance from the boundary. Returns false when the refinement does not end.
  ///
  /// @errors   Error(Cancelled)
  /// @source   Liepa 2003, Filling Holes in Meshes
  [[nodiscard]] bool refine_coarsely(const Run& run = {});

  /// Splits edges that are longer than those around the boundary. New vertices lie on a curve
  /// between the ends; `curvature` is the share of its height. Returns false when the refinement
  /// does not end, because the patch is crumpled.
  ///
  /// @errors   Error(Cancelled)
  [[nodiscard]] bool refine_finely(const PatchSurroundings& around,
                                   double curvature = 1.0,
                                   const Run& run = {});

 private:
  [[nodiscard]] static double target_edge_mm(const PatchSpacing& at);
  [[nodiscard]] double target_triangle_count() const;
  void split_if_large(std::uint32_t triangle);
  struct EdgeSplit {
    const std::vector<Eigen::Vector3d>& normals;
    double coarsening;  ///< factor of the target edge length
    double curvature;   ///< share of the height of the curve
  };
  void split_if_long(std::uint32_t edge, const EdgeSplit& split);

  PatchMesh& patch_;
  std::vector<PatchSpacing> spacing_;
};

}  // namespace frangia
