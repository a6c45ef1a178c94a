#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// A growing patch over a hole: a disk of triangles whose first vertices are the boundary of the
/// patch, in order. Half-edge 3 t + i runs from corner i of triangle t. Unlike HalfEdges it
/// supports splits and flips.
///
/// Inner edges are kept Delaunay: the two angles opposite to an edge add up to at most 180 degrees,
/// unless the flip would fold the patch or duplicate an edge of the mesh.
///
/// @source   Liepa 2003, Filling Holes in Meshes; Lawson 1977 for edge flips
class PatchMesh {
 public:
  static constexpr std::uint32_t kBoundary = 0xFFFFFFFF;  ///< twin of a boundary half-edge
  /// Whether the mesh has an edge between two boundary vertices.
  using AreAdjacent = std::function<bool(std::uint32_t, std::uint32_t)>;

  PatchMesh(std::vector<Eigen::Vector3d> boundary_mm,
            const std::vector<std::array<std::size_t, 3>>& triangles,
            AreAdjacent are_adjacent);

  [[nodiscard]] std::uint32_t boundary_vertices() const { return boundary_vertices_; }
  [[nodiscard]] std::uint32_t count() const {
    return static_cast<std::uint32_t>(positions_.size());
  }
  [[nodiscard]] std::uint32_t half_edges() const {
    return static_cast<std::uint32_t>(from_.size());
  }
  [[nodiscard]] std::uint32_t from(std::uint32_t edge) const { return from_[edge]; }
  [[nodiscard]] std::uint32_t to(std::uint32_t edge) const { return from_[next(edge)]; }
  [[nodiscard]] std::uint32_t twin(std::uint32_t edge) const { return twins_[edge]; }
  [[nodiscard]] const Eigen::Vector3d& position(std::uint32_t vertex) const {
    return positions_[vertex];
  }
  void move(std::uint32_t vertex, const Eigen::Vector3d& position_mm) {
    positions_[vertex] = position_mm;
  }

  /// Insert a vertex into a triangle or an inner edge, restore the Delaunay property around it, and
  /// return its index.
  std::uint32_t split_triangle(std::uint32_t triangle, const Eigen::Vector3d& position_mm);
  std::uint32_t split_edge(std::uint32_t edge, const Eigen::Vector3d& position_mm);

  /// Flips edges until all are Delaunay.
  void restore_delaunay();

  [[nodiscard]] static std::uint32_t next(std::uint32_t edge) {
    return edge % 3 == 2 ? edge - 2 : edge + 1;
  }
  [[nodiscard]] static std::uint32_t previous(std::uint32_t edge) {
    return edge % 3 == 0 ? edge + 2 : edge - 1;
  }

 private:
  std::uint32_t add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void link(std::uint32_t one, std::uint32_t other);
  [[nodiscard]] Eigen::Vector3d cross(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] bool should_flip(std::uint32_t edge) const;
  [[nodiscard]] bool can_flip(std::uint32_t edge) const;
  [[nodiscard]] bool are_connected(std::uint32_t outgoing, std::uint32_t other) const;
  void flip(std::uint32_t edge);
  void flip_pending();

  std::uint32_t boundary_vertices_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<std::uint32_t> from_;
  std::vector<std::uint32_t> twins_;
  std::vector<std::uint32_t> pending_;  ///< edges to test for a flip
  AreAdjacent are_adjacent_;
};

}  // namespace frangia
