#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// The point of an exact surface nearest to a query point.
struct ExactPoint {
  Eigen::Vector3d point_mm;         ///< on the surface
  Eigen::Vector3d normal;           ///< unit, outward; at an edge of the face nearest in direction
  double distance_mm = 0.0;         ///< never negative
  double signed_distance_mm = 0.0;  ///< positive on the side of the normal
  std::uint32_t face = 0;           ///< index of the face
  bool on_boundary = false;         ///< on an edge that a single face has: the surface ends there
};

/// A surface that a mesh approximates, such as the faces of a CAD model. Queries may come from
/// several threads.
class ExactSurface {
 public:
  ExactSurface() = default;
  ExactSurface(const ExactSurface&) = delete;
  ExactSurface& operator=(const ExactSurface&) = delete;
  ExactSurface(ExactSurface&&) = delete;
  ExactSurface& operator=(ExactSurface&&) = delete;
  virtual ~ExactSurface() = default;

  /// Returns the point of the surface nearest to `point_mm`. `start` is the nearest point of the
  /// mesh that approximates it.
  ///
  /// @units    mm
  [[nodiscard]] virtual ExactPoint nearest(const Eigen::Vector3d& point_mm,
                                           const NearestPoint& start) const = 0;
};

}  // namespace frangia
