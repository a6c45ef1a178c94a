#pragma once

#include <cstddef>
#include <vector>

#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// Where a surface sees itself, as a coarse grid of cells over it. A point whose cell and the cells
/// about it see nothing gets no light from other parts.
///
/// Some points of each cell look in 48 directions of equal cosine-weighted solid angle. What none
/// of them sees fills less than two hundredths of the hemisphere.
class SurfaceSight {
 public:
  /// @param scene        the surface, object frame
  /// @param step_off_mm  distance of ray origins from the surface
  SurfaceSight(const RayScene& scene, double step_off_mm);

  /// Whether a part of the surface, or of its inside through a hole, may be seen from a triangle.
  [[nodiscard]] bool sees_surface(std::size_t triangle) const { return sees_[triangle] != 0; }

 private:
  std::vector<char> sees_;  ///< by triangle
};

}  // namespace frangia
