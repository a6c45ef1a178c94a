#include "frangia/features/internal/shape_distance_between.h"

#include <cmath>

#include <Eigen/Geometry>

#include "frangia/features/geometric_tolerance.h"

namespace frangia {
namespace {

/// Whether the place of a shape is its axis.
bool is_axial(ShapeKind kind) {
  return kind == ShapeKind::Line || kind == ShapeKind::Cylinder || kind == ShapeKind::Cone;
}

constexpr double kParallel = 0.02;  // sine; about 1 degree

/// The point of the plane or the axis of a shape, or its center, that is nearest to a point.
Eigen::Vector3d foot_on(const Shape& shape, const Eigen::Vector3d& point_mm) {
  const double along = (point_mm - shape.center_mm).dot(shape.axis);
  if (shape.kind == ShapeKind::Plane) return point_mm - along * shape.axis;
  if (is_axial(shape.kind)) return shape.center_mm + along * shape.axis;
  return shape.center_mm;
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
  const Eigen::Vector3d across = shape.axis.cross(datum.axis);
  if (across.norm() < kParallel) return distance_between(datum, shape.center_mm);
  return std::abs((shape.center_mm - datum.center_mm).dot(across.normalized()));
}

ShapeEnds ends_between(const Shape& shape, const Shape& datum) {
  if (datum.kind == ShapeKind::Plane) return {shape.center_mm, foot_on(datum, shape.center_mm)};
  if (shape.kind == ShapeKind::Plane) return {foot_on(shape, datum.center_mm), datum.center_mm};
  const bool skew = is_axial(shape.kind) && is_axial(datum.kind) &&
                    shape.axis.cross(datum.axis).norm() >= kParallel;
  if (skew) {
    const Eigen::Vector3d offset = datum.center_mm - shape.center_mm;
    const double cosine = shape.axis.dot(datum.axis);
    const double sine2 = 1.0 - cosine * cosine;
    const double s = (offset.dot(shape.axis) - cosine * offset.dot(datum.axis)) / sine2;
    const double t = (cosine * offset.dot(shape.axis) - offset.dot(datum.axis)) / sine2;
    return {shape.center_mm + s * shape.axis, datum.center_mm + t * datum.axis};
  }
  if (is_axial(shape.kind) && !is_axial(datum.kind))
    return {foot_on(shape, datum.center_mm), datum.center_mm};
  return {shape.center_mm, foot_on(datum, shape.center_mm)};
}

}  // namespace frangia
