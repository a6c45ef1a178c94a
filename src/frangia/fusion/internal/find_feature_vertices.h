#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/fusion/internal/edge_limits.h"
#include "frangia/geometry/connectivity.h"
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

/// The faces, edge or corner of the object that a vertex near an edge lies on.
struct FeatureVertex {
  enum class Kind : std::uint8_t { Unknown, Face, Edge, Corner };

  Kind kind = Kind::Unknown;
  Faces faces;                                       ///< those it lies on come first
  Eigen::Vector3f target = Eigen::Vector3f::Zero();  ///< position of the vertex on them

  [[nodiscard]] const Faces::Plane& face() const { return faces.planes[0]; }
  /// Returns the largest cosine between a normal and the faces that the vertex lies on.
  [[nodiscard]] float agreement(const Eigen::Vector3f& normal) const;
};

/// The vertices near edges of the object and their features.
struct FeatureVertices {
  static constexpr std::uint32_t kNone = ~0U;

  std::vector<std::uint32_t> vertices;
  std::vector<FeatureVertex> features;  ///< one for each of `vertices`
  LargeVector<std::uint32_t> index_of;  ///< for each vertex of the mesh, or kNone

  /// Returns the feature of a vertex of the mesh; null when it is unknown.
  [[nodiscard]] const FeatureVertex* at(std::uint32_t vertex) const {
    const FeatureVertex* found = index_of[vertex] == kNone ? nullptr : &features[index_of[vertex]];
    return found == nullptr || found->kind == FeatureVertex::Kind::Unknown ? nullptr : found;
  }
};

/// Returns the vertices of triangles that deviate from the normals of their vertices by more than
/// `chamfer_rad`, in ascending order: they lie on edges that sampling cut off.
[[nodiscard]] std::vector<std::uint32_t> chamfer_vertices(const Mesh& mesh,
                                                          const EdgeLimits& limits);

/// Finds the features of the chamfer vertices and their neighbours.
///
/// The faces are fitted to the vertices beyond, up to `face_reach_voxels` away. They are valid when
/// all of the surface around a vertex lies on one of them or near one of their edges.
[[nodiscard]] FeatureVertices find_feature_vertices(const Mesh& mesh,
                                                    const OneRings& one_rings,
                                                    std::span<const std::uint32_t> chamfered,
                                                    const EdgeLimits& limits);

}  // namespace frangia
