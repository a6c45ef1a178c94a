#pragma once

#include <string_view>

#include <Eigen/Core>

#include "frangia/core/enum_names.h"

namespace frangia {

/// Kinds of geometrical elements that are found in a mesh.
enum class ShapeKind { Plane, Line, Circle, Cylinder, Sphere, Cone, Torus };

/// What users call them.
[[nodiscard]] constexpr auto names_of(ShapeKind /*any*/) {
  return EnumNames<ShapeKind, 7>{{{ShapeKind::Plane, "plane"},
                                  {ShapeKind::Line, "line"},
                                  {ShapeKind::Circle, "circle"},
                                  {ShapeKind::Cylinder, "cylinder"},
                                  {ShapeKind::Sphere, "sphere"},
                                  {ShapeKind::Cone, "cone"},
                                  {ShapeKind::Torus, "torus"}}};
}

/// An ideal geometrical element.
///
/// Plane: through the center, normal to the axis. Line: through the center along the axis. Circle:
/// about the center, in the plane normal to the axis. Cylinder: about the line through the center
/// along the axis. Cone: `radius_mm` at the center, growing along the axis. Torus: `radius_mm` is
/// that of the circle about the center on which the centers of the tube lie.
struct Shape {
  ShapeKind kind = ShapeKind::Plane;                    ///< which of the members have a meaning
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< a point of the element, see above
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();      ///< unit; no meaning for a sphere
  double radius_mm = 0.0;                               ///< none for a plane and a line
  double half_angle_rad = 0.0;                          ///< of a cone, between axis and surface
  double tube_radius_mm = 0.0;                          ///< of a torus
};

/// Whether a kind is a surface, which points of a mesh lie on: all but line and circle.
[[nodiscard]] bool is_surface(ShapeKind kind);

/// Number of parameters that a fit of this kind of surface determines: 3 to 7.
[[nodiscard]] int parameter_count(ShapeKind kind);

/// Distance of a point from a shape and its derivatives.
struct ShapeDistance {
  double distance_mm = 0.0;                          ///< signed: positive along the normal
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit gradient of the distance
  /// Derivatives with respect to the parameters of `moved`; zero beyond `parameter_count`.
  Eigen::Matrix<double, 7, 1> derivatives = Eigen::Matrix<double, 7, 1>::Zero();
};

/// Computes the orthogonal distance of a point from a surface. The normal points away from the axis
/// of a cylinder or cone, the center of a sphere and the tube of a torus, and along the axis of a
/// plane.
///
/// @units    mm
/// @missing  the normal is not finite on the axis or the center
/// @errors   Error(Input) for a line or a circle
[[nodiscard]] ShapeDistance distance_to(const Shape& shape, const Eigen::Vector3d& point_mm);

/// Moves a surface by a step in its parameters: of the center, along two directions normal to the
/// axis (and along it for a torus, along it alone for a plane, in x, y, z for a sphere); of the
/// axis, towards the same two directions; of the radius; of the angle or the radius of the tube.
///
/// @units    mm, and rad for the axis and the angle
/// @errors   Error(Input) for a line or a circle
[[nodiscard]] Shape moved(const Shape& shape, const Eigen::VectorXd& step);

/// Number of the parameter that states the size: the radius. The offset along the normal for a
/// plane.
[[nodiscard]] int size_parameter(ShapeKind kind);

}  // namespace frangia
