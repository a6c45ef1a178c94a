#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Geometry>

#include "frangia/fusion/internal/edge_limits.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Up to three faces of the object near a point, the nearest one first.
struct Faces {
  using Plane = Eigen::Hyperplane<float, 3>;

  std::array<Plane, 3> planes;
  std::size_t count = 0;
};

/// Whether two faces with these normals form an edge: whether their angle is between `min_edge_rad`
/// and `max_edge_rad`.
[[nodiscard]] bool form_edge(const Eigen::Vector3f& one,
                             const Eigen::Vector3f& other,
                             const EdgeLimits& limits);

/// Returns the point nearest to `from` on both planes, which must not be parallel.
[[nodiscard]] Eigen::Vector3f intersect_planes(const Faces::Plane& one,
                                               const Faces::Plane& other,
                                               const Eigen::Vector3f& from);

/// Returns the intersection of three planes, which must be independent.
[[nodiscard]] Eigen::Vector3f intersect_planes(const std::array<Faces::Plane, 3>& planes,
                                               const Eigen::Vector3f& from);

/// Fits faces to vertices: the largest set of vertices with similar normals in one plane, then the
/// next one among the rest.
///
/// @missing  a set of fewer than `min_face_vertices`, or one that is not flat, is no face
[[nodiscard]] Faces find_faces(const Mesh& mesh,
                               std::span<const std::uint32_t> vertices,
                               const Eigen::Vector3f& near,
                               const EdgeLimits& limits);

}  // namespace frangia
