#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mesh.h"
#include "frangia/mesh/internal/quadric.h"

namespace frangia {

/// The position that an edge collapses to, and its error.
struct CollapseTarget {
  Eigen::Vector3d position;
  double cost = 0.0;         ///< quadric error: mm2 weighted by area
  double mean_square = 0.0;  ///< mean squared distance to the planes of the quadric, mm2
};

/// The error quadrics of the vertices of a mesh during decimation.
///
/// Triangles are weighted by area and by 1/sigma^2. Planes perpendicular to the surface constrain
/// boundaries.
///
/// @source   Garland & Heckbert 1997, Surface Simplification Using Quadric Error Metrics
class CollapseCost {
 public:
  /// `mesh` must outlive it; its vertices may move.
  CollapseCost(const Mesh& mesh, const HalfEdges& edges);

  [[nodiscard]] CollapseTarget target(std::uint32_t a, std::uint32_t b) const;
  /// Adds the quadric of b to that of a.
  void collapse(std::uint32_t a, std::uint32_t b) { quadrics_[a] += quadrics_[b]; }

 private:
  [[nodiscard]] Eigen::Vector3d position(std::uint32_t v) const {
    return mesh_->vertices_mm[v].cast<double>();
  }
  [[nodiscard]] double confidence(const Mesh::Triangle& triangle) const;
  void constrain_boundary(std::uint32_t edge, const Eigen::Vector3d& normal);

  const Mesh* mesh_;
  double median_sigma_mm_ = 0.0;
  std::vector<Quadric> quadrics_;
};

}  // namespace frangia
