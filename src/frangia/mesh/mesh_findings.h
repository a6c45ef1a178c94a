#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The extent, components, holes and faults of a mesh.
struct MeshFindings {
  std::size_t vertices = 0;               ///< number of vertices
  std::size_t triangles = 0;              ///< number of triangles
  std::vector<MeshComponent> components;  ///< connected components
  std::vector<BoundaryLoop> holes;        ///< boundary loops
  /// Edges with more than two triangles, or with two triangles of opposite orientation.
  std::size_t non_manifold_edges = 0;
  std::size_t degenerate_triangles = 0;  ///< triangles with two equal or three collinear corners
  /// Pairs of intersecting triangles; nullopt in a build without CGAL.
  std::optional<std::size_t> self_intersections;
  std::array<std::size_t, 3> marks{};  ///< triangles by Mark: measured, displaced, synthesized
  double area_mm2 = 0.0;               ///< total area of the triangles
  /// Signed volume; NaN unless as many triangles run along each edge in one direction as in the
  /// other, which holds for closed bodies that share an edge, too.
  double volume_mm3 = 0.0;
  Eigen::AlignedBox3d box_mm;  ///< bounding box of the vertices
  bool closed = false;         ///< neither boundary nor non-manifold edges
};

/// Analyses a mesh.
///
/// @errors   Error(Input) when a triangle refers to a vertex that does not exist; Error(Cancelled)
[[nodiscard]] MeshFindings mesh_findings(const Mesh& mesh, const Run& run = {});

}  // namespace frangia
