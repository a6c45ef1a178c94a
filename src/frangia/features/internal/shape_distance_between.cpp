#include "frangia/features/internal/shape_distance_between.h"

#include <cmath>

#include <Eigen/Geometry>

namespace frangia {
namespace {

/// Whether the place of a shape is its axis.
bool is_axial(ShapeKind kind) {
  return kind == ShapeKind::Line || kind == ShapeKind::Cylinder || kind == ShapeKind::Cone;
}

}  // namespace

bool has_axis(ShapeKind kind) {
  return kind != ShapeKind::Sphere;
}

double distance_between(const Shape& shape, const Eigen::Vector3d& point_mm) {
  const Eigen::Vector3d offset = point_mm - shape.center_mm;
  if (shape.kind == ShapeKind::Plane) return std::abs(offset.dot(shape.axis));
  if (is_axial(shape.kind)) return offset.cross(shape.axis).norm();
  return offset.norm();
}

double distance_between(const Shape& shape, const Shape& datum) {
  if (datum.kind == ShapeKind::Plane) return distance_between(datum, shape.center_mm);
  if (shape.kind == ShapeKind::Plane) return distance_between(shape, datum.center_mm);
  if (!is_axial(shape.kind)) return distance_between(datum, shape.center_mm);
  if (!is_axial(datum.kind)) return distance_between(shape, datum.center_mm);
  constexpr double kParallel = 0.02;  // sine; about 1 degree
  const Eigen::Vector3d across = shape.axis.cross(datum.axis);
  if (across.norm() < kParallel) return distance_between(datum, shape.center_mm);
  return std::abs((shape.center_mm - datum.center_mm).dot(across.normalized()));
}

}  // namespace frangia
