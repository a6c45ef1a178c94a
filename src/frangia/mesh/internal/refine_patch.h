#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/mesh/internal/fair_patch.h"
#include "frangia/mesh/internal/patch_mesh.h"

namespace frangia {

/// How long edges at a patch's vertex should be, and how far it is from the boundary.
struct PatchSpacing {
  double edge_mm = 0.0;
  double from_boundary_mm = 0.0;
};

/// Makes a patch denser: first coarsely, for its shape, then as dense as the surface around it.
class PatchRefinement {
 public:
  /// `patch` must outlive it; there is one spacing for each of its vertices.
  PatchRefinement(PatchMesh& patch, std::vector<PatchSpacing> spacing);

  /// Puts a vertex into each triangle that is large for its corners, until none is. Triangles grow
  /// with their distance from the boundary. False when there is no end to it.
  /// source  Liepa 2003, Filling Holes in Meshes
  [[nodiscard]] bool refine_coarsely();

  /// Cuts edges that are longer than those around the boundary, along this share of the curve
  /// between their ends. False when there is no end to it: the patch is crumpled.
  [[nodiscard]] bool refine_finely(const PatchSurroundings& around, double curvature = 1.0);

 private:
  [[nodiscard]] static double target_edge_mm(const PatchSpacing& at);
  [[nodiscard]] double target_triangle_count() const;
  void split_if_large(std::uint32_t triangle);
  struct Cut {
    const std::vector<Eigen::Vector3d>& normals;
    double coarser;    ///< how many times longer edges may be than around the boundary
    double curvature;  ///< share of the curve
  };
  void split_if_long(std::uint32_t edge, const Cut& cut);

  PatchMesh& patch_;
  std::vector<PatchSpacing> spacing_;
};

}  // namespace frangia
