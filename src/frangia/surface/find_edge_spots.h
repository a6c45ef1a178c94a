#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/surface/fans.h"
#include "frangia/surface/find_faces.h"

namespace frangia {

/// Where a vertex beside an edge of the object belongs.
struct EdgeSpot {
  enum class Kind : std::uint8_t { Unknown, Face, Edge, Corner };

  Kind kind = Kind::Unknown;
  Faces faces;                                       ///< first those it lies on
  Eigen::Vector3f target = Eigen::Vector3f::Zero();  ///< where the vertex goes

  [[nodiscard]] const Faces::Plane& face() const { return faces.planes[0]; }
  /// The cosine between a normal and the nearest of the faces that the vertex lies on.
  [[nodiscard]] float agreement(const Eigen::Vector3f& normal) const;
};

/// The vertices near edges of the object, and what is known of them.
struct EdgeSpots {
  static constexpr std::uint32_t kNone = ~0U;

  std::vector<std::uint32_t> vertices;
  std::vector<EdgeSpot> spots;        ///< one for each of them
  LargeVector<std::uint32_t> places;  ///< of each vertex of the mesh in there, or kNone

  /// Null where nothing is known.
  [[nodiscard]] const EdgeSpot* at(std::uint32_t vertex) const {
    const EdgeSpot* found = places[vertex] == kNone ? nullptr : &spots[places[vertex]];
    return found == nullptr || found->kind == EdgeSpot::Kind::Unknown ? nullptr : found;
  }
};

/// The vertices at triangles that slope otherwise, by 15 degrees, than the views say there: they
/// are on edges that were cut off. In ascending order.
[[nodiscard]] std::vector<std::uint32_t> rough_vertices(const Mesh& mesh);

/// What the rough vertices, and their neighbours, belong to.
///
/// The faces are those of the vertices beyond, as far as five voxels. They count where all of the
/// surface around a vertex is on one of them, but for what lies close to an edge.
[[nodiscard]] EdgeSpots find_edge_spots(const Mesh& mesh,
                                        const Fans& fans,
                                        std::span<const std::uint32_t> rough,
                                        float voxel_mm);

}  // namespace frangia
