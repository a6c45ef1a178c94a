#include "frangia/inspection/internal/shape_mismatch.h"

#include <cmath>

namespace frangia {

double shape_mismatch_mm(const PlannedFeature& planned, const Shape& shape) {
  const Eigen::Vector3d offset = planned.near_mm - shape.center_mm;
  const bool flat = shape.kind == ShapeKind::Plane;
  // Along a plane or an axis the place is less certain than across it.
  const double along = offset.dot(shape.axis);
  const double across = (offset - along * shape.axis).norm();
  constexpr double kLoose = 0.2;
  const bool point = shape.kind == ShapeKind::Sphere || shape.kind == ShapeKind::Circle ||
                     shape.kind == ShapeKind::Torus;
  double place = offset.norm();
  if (!point) {
    place = flat ? std::abs(along) + kLoose * across : across + kLoose * std::abs(along);
  }
  const double size =
      planned.diameter_mm ? std::abs(2.0 * shape.radius_mm - *planned.diameter_mm) : 0.0;
  return place + size;
}

}  // namespace frangia
