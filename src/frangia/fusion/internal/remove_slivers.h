#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Whether a triangle's height over its longest edge is below `lowest_mm`.
[[nodiscard]] bool is_low(const Mesh& mesh, const Mesh::Triangle& t, float lowest_mm);

/// The few triangles of a mesh that may be slivers or caps.
class SliverCandidates {
 public:
  /// Collects triangles with an edge shorter than `shortest_mm` or a height below `lowest_mm`.
  SliverCandidates(const Mesh& mesh, float shortest_mm, float lowest_mm);

  /// The candidates in ascending order.
  [[nodiscard]] const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  /// Adds triangles in ascending order that have changed or whose neighbours have.
  void add(const std::vector<std::uint32_t>& triangles);

 private:
  std::vector<std::uint32_t> triangles_;
};

/// A triangle with additional points: 0 to 2 are its corners, 3 + i lies on the edge from corner i
/// to the next, and 6 lies inside.
struct SplitTriangle {
  std::array<Eigen::Vector3f, 7> points;
  unsigned split = 0;  ///< bit i: edge i has a point; with all three, the inner point is used, too

  using Piece = std::array<std::uint8_t, 3>;
  std::array<Piece, 6> pieces{};
  std::size_t count = 0;
};

/// Cuts the triangle into one to six pieces of the same orientation with all its points as corners.
void triangulate(SplitTriangle& triangle);

/// Collapses edges shorter than `shortest_mm`, in place. Returns whether any was collapsed.
///
/// A vertex on a corner of the object keeps its position before one on an edge, and that before any
/// other; two of the same kind meet in the middle. No collapse folds a triangle over or makes the
/// mesh non-manifold. Removed triangles stay in the list with three times vertex 0.
///
/// @shape    `sharp`: 1 for a vertex on an edge of the object, 2 on a corner, else 0; it may be
///          shorter than the list of vertices. `candidates`: the triangles to examine; those around
///          collapsed edges are added
bool collapse_slivers(Mesh& mesh,
                      std::span<const std::uint8_t> sharp,
                      float shortest_mm,
                      SliverCandidates& candidates,
                      const CleanupParameters& parameters = {});

/// Flips the longest edge of each triangle lower than `lowest_mm`, in place. Returns whether any
/// edge was flipped.
///
/// No flip folds a triangle over or makes the mesh non-manifold. `candidates` are the triangles to
/// examine; those around flipped edges are added.
bool flip_caps(Mesh& mesh, float lowest_mm, SliverCandidates& candidates);

/// Removes triangles lower than `lowest_mm` and edges shorter than twice that, in place.
///
/// @shape    `sharp`: see `collapse_slivers`
void remove_slivers(Mesh& mesh,
                    std::span<const std::uint8_t> sharp,
                    float lowest_mm,
                    const CleanupParameters& parameters = {});

}  // namespace frangia
