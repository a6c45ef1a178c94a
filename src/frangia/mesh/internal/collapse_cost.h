#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mesh.h"
#include "frangia/mesh/internal/quadric.h"

namespace frangia {

/// Where the two ends of an edge are joined, and what it costs.
struct CollapseTarget {
  Eigen::Vector3d position;
  double cost = 0.0;         ///< mm2 weighted by area
  double mean_square = 0.0;  ///< mm2: of the distances to the planes that the position stands for
};

/// The planes that each vertex of a mesh stands for while edges are joined.
///
/// Vertices that were measured well weigh more than ones with a large sigma; boundaries are held by
/// planes that stand on them.
/// source   Garland & Heckbert 1997, Surface Simplification Using Quadric Error Metrics
class CollapseCost {
 public:
  /// `mesh` must outlive it; its vertices may move.
  CollapseCost(const Mesh& mesh, const HalfEdges& edges);

  [[nodiscard]] CollapseTarget target(std::uint32_t a, std::uint32_t b) const;
  /// Vertex a stands for what b stood for, too.
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
