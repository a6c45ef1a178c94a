#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/fusion/internal/edge_limits.h"
#include "frangia/fusion/internal/find_feature_vertices.h"

namespace frangia {

/// A new vertex on the mesh edge between two vertices.
struct EdgeSplit {
  std::uint32_t a, b;  ///< a < b
  Eigen::Vector3f point;

  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> ends() const { return {a, b}; }
};

/// The changes that sharpen a mesh: new positions of vertices, and splits of mesh edges.
struct SharpeningPlan {
  const Mesh& mesh;
  const OneRings& one_rings;
  const EdgeLimits& limits;
  FeatureVertices features;
  std::vector<EdgeSplit> splits;  ///< ascending by their ends

  /// Returns the new position of a vertex.
  [[nodiscard]] Eigen::Vector3f target(std::uint32_t v) const;
  /// Returns the split of the mesh edge between two vertices; null without one.
  [[nodiscard]] const EdgeSplit* between(std::uint32_t a, std::uint32_t b) const;
};

/// Plans the splits for the plan's features.
///
/// Edges of the object with fewer than `min_edge_vertices` are removed, with their features. Face
/// vertices next to no split keep their measured position.
void plan_splits(SharpeningPlan& plan);

}  // namespace frangia
