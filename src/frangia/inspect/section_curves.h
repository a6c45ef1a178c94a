#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A plane and two directions in it.
struct SectionPlane {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< origin of the coordinates in the plane
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();        ///< unit, in the plane
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();        ///< normal x u
};

/// A plane through a point, seen against its normal as the part stands: `u` is horizontal and `v`
/// leads up, along z. Where the plane is nearly horizontal, `u` is the x axis projected into it.
///
/// @errors   Error(Input) when the normal is zero
[[nodiscard]] SectionPlane section_plane(const Eigen::Vector3d& point_mm,
                                         const Eigen::Vector3d& normal);

/// A curve in which a plane cuts a mesh.
struct SectionCurve {
  std::vector<Eigen::Vector2d> points_mm;  ///< coordinates along `u` and `v`
  std::vector<double> values;              ///< of the vertices, interpolated; or empty
  bool closed = false;                     ///< the last point is followed by the first
};

/// Cuts a mesh by a plane. The material is at the left of each curve, seen against the normal.
/// Synthesized triangles are left out, so that curves are open at filled holes.
///
/// @shape    the longest curve first
/// @missing  a value is NaN where that of a neighboring vertex is
/// @errors   Error(Input) when `values` is neither empty nor one for each vertex
[[nodiscard]] std::vector<SectionCurve> section_curves(const Mesh& mesh,
                                                       const SectionPlane& plane,
                                                       const std::vector<float>& values = {});

/// Length of a curve.
///
/// @units    mm
[[nodiscard]] double length_mm(const SectionCurve& curve);

/// Area of the material in a section: what outer curves enclose, less what holes do.
///
/// @units    mm^2
/// @missing  NaN where a curve is open
[[nodiscard]] double area_mm2(const std::vector<SectionCurve>& curves);

}  // namespace frangia
