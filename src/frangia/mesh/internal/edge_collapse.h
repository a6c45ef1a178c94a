#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The weighted sum of squared distances to planes, as a function of position: p'Ap + 2 b'p + c.
struct Quadric {
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0.0;
  double weight = 0.0;

  void add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& through, double w) {
    const double d = -normal.dot(through);
    xx += w * normal.x() * normal.x();
    xy += w * normal.x() * normal.y();
    xz += w * normal.x() * normal.z();
    yy += w * normal.y() * normal.y();
    yz += w * normal.y() * normal.z();
    zz += w * normal.z() * normal.z();
    b += w * d * normal;
    c += w * d * d;
    weight += w;
  }
  Quadric& operator+=(const Quadric& q) {
    xx += q.xx;
    xy += q.xy;
    xz += q.xz;
    yy += q.yy;
    yz += q.yz;
    zz += q.zz;
    b += q.b;
    c += q.c;
    weight += q.weight;
    return *this;
  }
  [[nodiscard]] Eigen::Vector3d times(const Eigen::Vector3d& p) const {
    return {xx * p.x() + xy * p.y() + xz * p.z(),
            xy * p.x() + yy * p.y() + yz * p.z(),
            xz * p.x() + yz * p.y() + zz * p.z()};
  }
  [[nodiscard]] double at(const Eigen::Vector3d& p) const {
    return std::max(0.0, p.dot(times(p)) + 2.0 * b.dot(p) + c);
  }
  /// Finds the position of the minimum; false when the planes do not determine it.
  [[nodiscard]] bool minimize(Eigen::Vector3d& position) const {
    const Eigen::Vector3d u(xx, xy, xz);
    const Eigen::Vector3d v(xy, yy, yz);
    const Eigen::Vector3d w(xz, yz, zz);
    const Eigen::Vector3d vw = v.cross(w);
    const double determinant = u.dot(vw);
    const double trace = xx + yy + zz;
    // The smallest eigenvalue may be about 1e-5 of the largest: below that, noise of the normals
    // decides along the smallest eigenvector.
    constexpr double kMinDeterminant = 1e-6;
    if (!(std::abs(determinant) > kMinDeterminant * trace * trace * trace)) return false;
    position = -(b.x() * vw + b.y() * w.cross(u) + b.z() * u.cross(v)) / determinant;
    return true;
  }
};

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

/// The adjacency of a mesh during edge collapses. Corner 3 t + i is corner i of triangle t, as in
/// HalfEdges. HalfEdges itself is immutable and keeps neighbours in arrays that cannot merge; here
/// the corners of a vertex form a linked list, so a collapse joins two lists.
class CollapseTopology {
 public:
  /// `mesh` must outlive the object; collapse() changes its triangles.
  CollapseTopology(Mesh& mesh, const HalfEdges& edges);

  /// Calls `work(corner)` for each corner of a remaining triangle at a vertex.
  template <typename Work>
  void for_each_corner(std::uint32_t vertex, const Work& work) const {
    for (std::uint32_t corner = first_[vertex]; corner != kNone; corner = next_corner_[corner])
      if (alive_[corner / 3] != 0) work(corner);
  }
  [[nodiscard]] std::uint32_t at(std::uint32_t corner) const {
    return mesh_->triangles[corner / 3][corner % 3];
  }
  [[nodiscard]] bool is_removed(std::uint32_t vertex) const { return first_[vertex] == kNone; }
  [[nodiscard]] bool is_fixed(std::uint32_t vertex) const { return fixed_[vertex] != 0; }
  [[nodiscard]] std::size_t remaining_triangles() const { return remaining_triangles_; }
  [[nodiscard]] const std::vector<std::uint8_t>& alive() const { return alive_; }

  /// The link condition: whether the mesh stays manifold when b collapses into a.
  ///
  /// @source   Dey, Edelsbrunner, Guha & Nekhayev 1999, Topology Preserving Edge Contraction
  [[nodiscard]] bool can_collapse(std::uint32_t a, std::uint32_t b);

  /// Collapses b into a and removes the triangles of the edge.
  void collapse(std::uint32_t a, std::uint32_t b);

  /// The vertices of the one-ring, each once.
  void neighbors(std::uint32_t vertex, std::vector<std::uint32_t>& found);

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct OneRingCounts {
    std::size_t triangles = 0;
    std::size_t shared_triangles = 0;
  };
  [[nodiscard]] OneRingCounts mark_neighbors(std::uint32_t a, std::uint32_t b, std::uint32_t stamp);

  Mesh* mesh_;
  std::size_t remaining_triangles_;
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint8_t> fixed_;         ///< at non-manifold edges
  std::vector<std::uint8_t> on_boundary_;   ///< on a boundary
  std::vector<std::uint32_t> first_;        ///< a corner of each vertex
  std::vector<std::uint32_t> next_corner_;  ///< the next corner of the same vertex
  std::vector<std::uint8_t> alive_;
};

}  // namespace frangia
