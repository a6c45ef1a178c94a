#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/fusion/internal/find_faces.h"
#include "frangia/geometry/one_rings.h"

namespace frangia {

/// Where a vertex beside an edge of the object belongs.
struct FeatureVertex {
  enum class Kind : std::uint8_t { Unknown, Face, Edge, Corner };

  Kind kind = Kind::Unknown;
  Faces faces;                                       ///< first those it lies on
  Eigen::Vector3f target = Eigen::Vector3f::Zero();  ///< where the vertex goes

  [[nodiscard]] const Faces::Plane& face() const { return faces.planes[0]; }
  /// The cosine between a normal and the nearest of the faces that the vertex lies on.
  [[nodiscard]] float agreement(const Eigen::Vector3f& normal) const;
};

/// The vertices near edges of the object, and what is known of them.
struct FeatureVertices {
  static constexpr std::uint32_t kNone = ~0U;

  std::vector<std::uint32_t> vertices;
  std::vector<FeatureVertex> features;  ///< one for each of them
  LargeVector<std::uint32_t> index_of;  ///< of each vertex of the mesh in there, or kNone

  /// Null where nothing is known.
  [[nodiscard]] const FeatureVertex* at(std::uint32_t vertex) const {
    const FeatureVertex* found = index_of[vertex] == kNone ? nullptr : &features[index_of[vertex]];
    return found == nullptr || found->kind == FeatureVertex::Kind::Unknown ? nullptr : found;
  }
};

/// The vertices at triangles that slope otherwise, by 15 degrees, than the views say there: they
/// are on edges that were cut off. In ascending order.
[[nodiscard]] std::vector<std::uint32_t> chamfer_vertices(const Mesh& mesh);

/// What the rough vertices, and their neighbours, belong to.
///
/// The faces are those of the vertices beyond, as far as five voxels. They count where all of the
/// surface around a vertex is on one of them, but for what lies close to an edge.
[[nodiscard]] FeatureVertices find_feature_vertices(const Mesh& mesh,
                                                    const OneRings& one_rings,
                                                    std::span<const std::uint32_t> chamfered,
                                                    float voxel_mm);

}  // namespace frangia
