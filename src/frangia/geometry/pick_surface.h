#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "frangia/core/missing.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A ray from the eye, and what a section plane leaves of the surface.
struct PickRay {
  Eigen::Vector3d eye_mm = Eigen::Vector3d::Zero();      ///< in the frame of the mesh
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< of any length above 0
  /// Points with normal * p + offset below 0 are cut away. A normal of 0 cuts nothing.
  Eigen::Vector3d section_normal = Eigen::Vector3d::Zero();
  double section_offset_mm = 0.0;  ///< see `section_normal`
};

/// The point of a surface that was pointed at.
struct PickedPoint {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< in the frame of the mesh
  std::uint32_t triangle = 0;                          ///< of the exact mesh
  double sigma_mm = kMissing;                          ///< largest of the triangle's corners
};

/// Finds the first point of a surface on a ray, from either side of its triangles.
///
/// It intersects every triangle: a person points once in a while, and a search structure takes
/// longer to build than this loop.
/// @units    mm
/// @missing  empty where the ray meets nothing; sigma is NaN where it is not known
/// @source   Möller & Trumbore 1997
[[nodiscard]] std::optional<PickedPoint> pick_surface(const Mesh& mesh, const PickRay& ray);

}  // namespace frangia
