#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Planes of the object near a point, the nearest first.
struct Faces {
  using Plane = Eigen::Hyperplane<float, 3>;

  std::array<Plane, 3> planes;
  std::size_t count = 0;
};

/// Whether two faces make an edge: they differ by 30 to 140 degrees. The edge of a knife has no
/// place to speak of.
[[nodiscard]] bool form_edge(const Eigen::Vector3f& one, const Eigen::Vector3f& other);

/// The point nearest to `from` on both planes, which must not be parallel.
[[nodiscard]] Eigen::Vector3f intersect_planes(const Faces::Plane& one,
                                               const Faces::Plane& other,
                                               const Eigen::Vector3f& from);

/// The point on all three planes.
[[nodiscard]] Eigen::Vector3f intersect_planes(const std::array<Faces::Plane, 3>& planes,
                                               const Eigen::Vector3f& from);

/// How far a face is looked for, in voxels.
inline constexpr float kFaceReach = 5.0F;

/// The planes that some vertices lie on: those that lie and face alike, five of them or more.
///
/// missing  none where they are not flat, to their sigma and some hundredths of a voxel
[[nodiscard]] Faces find_faces(const Mesh& mesh,
                               std::span<const std::uint32_t> vertices,
                               const Eigen::Vector3f& near,
                               float voxel_mm);

}  // namespace frangia
