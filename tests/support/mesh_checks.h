#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

#include "support/analytic_views.h"
#include "support/test_meshes.h"

namespace frangia::testing {

/// How far the vertices are from a shape: RMS, the farthest, and the RMS in units of their own
/// sigma.
struct VertexErrors {
  double rms_mm = 0.0;
  double max_mm = 0.0;
  double rms_sigmas = 0.0;

  VertexErrors(const Mesh& mesh, const Shape& truth) {
    for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
      const double error = truth(mesh.vertices_mm[i].cast<double>());
      rms_mm += error * error;
      max_mm = std::max(max_mm, std::abs(error));
      rms_sigmas += std::pow(error / static_cast<double>(mesh.sigma_mm[i]), 2);
    }
    rms_mm = std::sqrt(rms_mm / static_cast<double>(mesh.vertices_mm.size()));
    rms_sigmas = std::sqrt(rms_sigmas / static_cast<double>(mesh.vertices_mm.size()));
  }
};

/// How often directed edges are used: in a manifold once, and once in reverse except at a boundary.
struct Edges {
  std::size_t repeated = 0;
  std::size_t open = 0;

  explicit Edges(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (const auto& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i)
        ++count[{t[i], t[(i + 1) % 3]}];
    }
    for (const auto& [edge, times] : count) {
      repeated += times > 1 ? 1U : 0U;
      open += count.contains({edge.second, edge.first}) ? 0U : 1U;
    }
  }
};

inline double segment_distance(const Eigen::Vector3d& p,
                               const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

inline double triangle_distance(const Eigen::Vector3d& p,
                                const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b,
                                const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const Eigen::Vector3d foot = p - normal * (normal.dot(p - a) / normal.squaredNorm());
  const bool within = normal.dot((b - a).cross(foot - a)) >= 0.0 &&
                      normal.dot((c - b).cross(foot - b)) >= 0.0 &&
                      normal.dot((a - c).cross(foot - c)) >= 0.0;
  if (within) return (p - foot).norm();
  return std::min(
      {segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

/// From a point to the mesh, by looking at every triangle that has a corner within `reach_mm`.
inline double mesh_distance(const Mesh& mesh, const Eigen::Vector3d& point, double reach_mm) {
  double best = reach_mm;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_mm[t[0]].cast<double>();
    if ((a - point).norm() > reach_mm) continue;
    best = std::min(best,
                    triangle_distance(point,
                                      a,
                                      mesh.vertices_mm[t[1]].cast<double>(),
                                      mesh.vertices_mm[t[2]].cast<double>()));
  }
  return best;
}

}  // namespace frangia::testing
