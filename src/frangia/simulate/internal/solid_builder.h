#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Points along a closed or an open polyline.
using Loop = std::vector<Eigen::Vector3d>;

/// A circle about an axis parallel to z, counter-clockwise seen from above, with `count` points.
[[nodiscard]] Loop circle(const Eigen::Vector3d& center, double radius, int count);

/// The same line the other way round.
[[nodiscard]] Loop reversed(const Loop& loop);

/// Builds a closed solid from its faces.
///
/// Neighbouring faces must have equal points along their shared edge; equal points become one
/// vertex. Faces are counter-clockwise seen from outside the solid. units    mm
class SolidBuilder {
 public:
  /// A plane face with holes in it; the holes run clockwise.
  /// @errors   Error(Numeric) when the loops cross each other or are no polygon
  void add_face(const Loop& outer, const std::vector<Loop>& holes = {});

  /// The band between two closed lines of equally many points, joined one by one. Both run
  /// counter-clockwise seen from `to`'s side for a band that faces outwards, as a pillar's does.
  void add_band(const Loop& from, const Loop& to);

  /// The band between two open lines.
  void add_strip(const Loop& from, const Loop& to);

  /// Triangles from each piece of a closed line to one point.
  void add_fan(const Loop& loop, const Eigen::Vector3d& tip);

  [[nodiscard]] Mesh build() const;

 private:
  void add_quad(const Loop& from, const Loop& to, std::size_t i, std::size_t next);

  std::vector<Eigen::Vector3d> corners_;  ///< three a triangle
};

}  // namespace frangia
