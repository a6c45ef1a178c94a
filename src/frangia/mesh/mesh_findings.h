#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/connected_components.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// What a mesh has, and what is wrong with it.
struct MeshFindings {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::vector<MeshComponent> components;
  std::vector<BoundaryLoop> holes;
  std::size_t non_manifold_edges = 0;
  std::size_t degenerate_triangles = 0;  ///< triangles with two equal corners, or all in a line
  /// Pairs of triangles that cross; nothing in a build without CGAL.
  std::optional<std::size_t> self_intersections;
  std::array<std::size_t, 3> marks{};  ///< triangles that are measured, moved, invented
  double area_mm2 = 0.0;
  double volume_mm3 = 0.0;  ///< of a closed mesh; of an open one a number without meaning
  Eigen::AlignedBox3d box_mm;
  bool closed = false;  ///< no hole, no edge that is not manifold
};

[[nodiscard]] MeshFindings mesh_findings(const Mesh& mesh, const Run& run = {});

}  // namespace frangia
