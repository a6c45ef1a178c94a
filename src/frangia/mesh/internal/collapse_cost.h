#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/geometry/half_edges.h"
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

}  // namespace frangia
