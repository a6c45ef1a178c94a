#include "frangia/features/shape.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// Two directions normal to an axis.
struct CrossAxes {
  Vector3d first, second;
};

CrossAxes cross_axes_of(const Vector3d& axis) {
  const Vector3d first = axis.unitOrthogonal();
  return {first, axis.cross(first)};
}

void require_surface(ShapeKind kind) {
  require(is_surface(kind), "lines and circles are not surfaces; name a kind of surface");
}

}  // namespace

bool is_surface(ShapeKind kind) {
  return kind != ShapeKind::Line && kind != ShapeKind::Circle;
}

int parameter_count(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::Plane:
      return 3;
    case ShapeKind::Sphere:
      return 4;
    case ShapeKind::Cylinder:
      return 5;
    case ShapeKind::Cone:
      return 6;
    case ShapeKind::Torus:
      return 7;
    default:
      return 0;
  }
}

int size_parameter(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::Sphere:
      return 3;
    case ShapeKind::Cylinder:
    case ShapeKind::Cone:
      return 4;
    case ShapeKind::Torus:
      return 5;
    default:
      return 0;
  }
}

ShapeDistance distance_to(const Shape& shape, const Vector3d& point_mm) {
  require_surface(shape.kind);
  ShapeDistance at;
  const Vector3d from = point_mm - shape.center_mm;
  if (shape.kind == ShapeKind::Sphere) {
    const double distance = from.norm();
    at.normal = from / distance;
    at.distance_mm = distance - shape.radius_mm;
    at.derivatives.head<3>() = -at.normal;
    at.derivatives[3] = -1.0;
    return at;
  }
  const CrossAxes cross = cross_axes_of(shape.axis);
  const double height = from.dot(shape.axis);
  if (shape.kind == ShapeKind::Plane) {
    at.normal = shape.axis;
    at.distance_mm = height;
    at.derivatives.head<3>() << -1.0, from.dot(cross.first), from.dot(cross.second);
    return at;
  }
  const Vector3d across = from - height * shape.axis;
  const double radius = across.norm();
  const Vector3d outward = across / radius;
  const double first = outward.dot(cross.first);
  const double second = outward.dot(cross.second);
  if (shape.kind == ShapeKind::Cylinder) {
    at.normal = outward;
    at.distance_mm = radius - shape.radius_mm;
    at.derivatives.head<5>() << -first, -second, -height * first, -height * second, -1.0;
    return at;
  }
  if (shape.kind == ShapeKind::Cone) {
    const double c = std::cos(shape.half_angle_rad);
    const double s = std::sin(shape.half_angle_rad);
    const double lever = height * c + radius * s;
    at.normal = c * outward - s * shape.axis;
    at.distance_mm = (radius - shape.radius_mm) * c - height * s;
    at.derivatives.head<6>() << -c * first, -c * second, -lever * first, -lever * second, -c,
        (shape.radius_mm - radius) * s - height * c;
    return at;
  }
  const double beyond = radius - shape.radius_mm;
  const double tube = std::hypot(beyond, height);
  const double a = beyond / tube;
  const double b = height / tube;
  const double lever = b * radius - a * height;
  at.normal = a * outward + b * shape.axis;
  at.distance_mm = tube - shape.tube_radius_mm;
  at.derivatives << -a * first, -a * second, -b, lever * first, lever * second, -a, -1.0;
  return at;
}

Shape moved(const Shape& shape, const Eigen::VectorXd& step) {
  require_surface(shape.kind);
  Shape to = shape;
  if (shape.kind == ShapeKind::Sphere) {
    to.center_mm += step.head<3>();
    to.radius_mm += step[3];
    return to;
  }
  const CrossAxes cross = cross_axes_of(shape.axis);
  const auto turn = [&](double first, double second) {
    to.axis = (shape.axis + first * cross.first + second * cross.second).normalized();
  };
  if (shape.kind == ShapeKind::Plane) {
    to.center_mm += step[0] * shape.axis;
    turn(step[1], step[2]);
    return to;
  }
  to.center_mm += step[0] * cross.first + step[1] * cross.second;
  if (shape.kind == ShapeKind::Torus) {
    to.center_mm += step[2] * shape.axis;
    turn(step[3], step[4]);
    to.radius_mm += step[5];
    to.tube_radius_mm += step[6];
    return to;
  }
  turn(step[2], step[3]);
  to.radius_mm += step[4];
  if (shape.kind == ShapeKind::Cone) {
    // The steps of the optimizer are derivatives' products: a far start must not leave a quadrant.
    constexpr double kLargest = 1.5;
    to.half_angle_rad = std::clamp(shape.half_angle_rad + step[5], -kLargest, kLargest);
  }
  return to;
}

}  // namespace frangia
