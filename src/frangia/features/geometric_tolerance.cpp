#include "frangia/features/geometric_tolerance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/features/feature_points.h"
#include "frangia/features/internal/form_width.h"
#include "frangia/features/internal/shape_distance_between.h"
#include "frangia/features/internal/shared_calibration.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Kind = ShapeKind;

constexpr std::array<std::string_view, 10> kCharacteristicNames{"flatness",
                                                                "roundness",
                                                                "cylindricity",
                                                                "parallelism",
                                                                "perpendicularity",
                                                                "position",
                                                                "run-out",
                                                                "total-run-out",
                                                                "distance",
                                                                "angle"};

const Shape& shape_of(const MeasuredFeature& measured) {
  return measured.feature.fit.shape;
}

[[noreturn]] void refuse_kind(Characteristic characteristic, ShapeKind kind) {
  throw Error(ErrorKind::Input,
              fmt::format("a {} has no {}; choose another feature or another characteristic",
                          name_of(kind),
                          name_of(characteristic)));
}

/// The values of a function at the points.
template <typename Value>
std::vector<SurfaceValue> values_of(const MeasuredFeature& measured, const Value& value) {
  std::vector<SurfaceValue> values;
  values.reserve(measured.points_mm.size());
  for (const Vector3d& point : measured.points_mm)
    values.push_back({point, value(point)});
  return values;
}

MeasuredValue measured_value(const FormWidth& width) {
  return {width.value, width.u95};
}

MeasuredValue form_of(Characteristic characteristic,
                      const MeasuredFeature& measured,
                      FormReference reference) {
  const Shape& shape = shape_of(measured);
  const Shape* const moving = reference == FormReference::MinimumZone ? &shape : nullptr;
  const auto residual = [&](const Vector3d& point) {
    return distance_to(shape, point).distance_mm;
  };
  const bool flat = characteristic == Characteristic::Flatness && shape.kind == Kind::Plane;
  const bool round = characteristic == Characteristic::Cylindricity && shape.kind == Kind::Cylinder;
  std::vector<SurfaceValue> residuals = values_of(measured, residual);
  if (flat || round)
    return measured_value(form_width(std::move(residuals), {moving, ZoneFreedom::All}));
  const bool turned =
      shape.kind == Kind::Cylinder || shape.kind == Kind::Cone || shape.kind == Kind::Sphere;
  if (characteristic != Characteristic::Roundness || !turned)
    refuse_kind(characteristic, shape.kind);
  return measured_value(largest_section_width(
      residuals, shape.center_mm, shape.axis, {moving, ZoneFreedom::Section}));
}

/// The width of the zone that is parallel to a direction's plane: the range of the points along it.
MeasuredValue zone_width(const MeasuredFeature& measured, const Vector3d& direction) {
  return measured_value(
      form_width(values_of(measured, [&](const Vector3d& p) { return p.dot(direction); })));
}

MeasuredValue orientation_of(Characteristic characteristic,
                             const MeasuredFeature& measured,
                             const MeasuredFeature& datum) {
  const Shape& shape = shape_of(measured);
  const Shape& to = shape_of(datum);
  if (!has_axis(shape.kind)) refuse_kind(characteristic, shape.kind);
  if (!has_axis(to.kind)) refuse_kind(characteristic, to.kind);
  const bool parallel = characteristic == Characteristic::Parallelism;
  const bool same_type = (shape.kind == Kind::Plane) == (to.kind == Kind::Plane);
  const bool axes_parallel = parallel == same_type;  // a plane's axis is its normal
  if (shape.kind == Kind::Plane) {
    if (axes_parallel) return zone_width(measured, to.axis);
    const Vector3d across = shape.axis - shape.axis.dot(to.axis) * to.axis;
    if (across.norm() < 1e-6) refuse_kind(characteristic, shape.kind);
    return zone_width(measured, across.normalized());
  }
  const double length = measured.high_mm - measured.low_mm;
  const double cosine = std::abs(shape.axis.dot(to.axis));
  const double sine = shape.axis.cross(to.axis).norm();
  const double u =
      std::hypot(measured.feature.uncertainty.axis_u95_rad, datum.feature.uncertainty.axis_u95_rad);
  return {length * (axes_parallel ? sine : cosine), length * u};
}

MeasuredValue run_out_of(Characteristic characteristic,
                         const MeasuredFeature& measured,
                         const MeasuredFeature& datum) {
  const Shape& axis = shape_of(datum);
  const Shape& shape = shape_of(measured);
  if (axis.kind != Kind::Cylinder && axis.kind != Kind::Cone && axis.kind != Kind::Line)
    refuse_kind(characteristic, axis.kind);
  if (measured.points_mm.empty()) refuse_kind(characteristic, shape.kind);
  // A cone's surface is not parallel to the axis; run-out is measured normal to the surface.
  const double slope = shape.kind == Kind::Cone ? shape.half_angle_rad : 0.0;
  const double sign = shape.axis.dot(axis.axis) < 0.0 ? -1.0 : 1.0;
  const auto value = [&](const Vector3d& point) {
    const Vector3d offset = point - axis.center_mm;
    const double along = offset.dot(axis.axis);
    if (shape.kind == Kind::Plane) return along;
    const double radius = (offset - along * axis.axis).norm();
    return radius * std::cos(slope) - sign * along * std::sin(slope);
  };
  const std::vector<SurfaceValue> values = values_of(measured, value);
  MeasuredValue result =
      measured_value(characteristic == Characteristic::TotalRunOut
                         ? form_width(values)
                         : largest_section_width(values, axis.center_mm, axis.axis));
  const double lever = (shape.center_mm - axis.center_mm).norm();
  const double tilt = datum.feature.uncertainty.axis_u95_rad * lever;
  result.u95 = std::hypot(result.u95, datum.feature.uncertainty.center_u95_mm, tilt);
  return result;
}

}  // namespace

std::string_view name_of(Characteristic characteristic) {
  return kCharacteristicNames.at(static_cast<std::size_t>(characteristic));
}

const std::vector<Characteristic>& all_characteristics() {
  static const std::vector<Characteristic> all = [] {
    std::vector<Characteristic> list;
    for (std::size_t i = 0; i < kCharacteristicNames.size(); ++i)
      list.push_back(static_cast<Characteristic>(i));
    return list;
  }();
  return all;
}

bool needs_datum(Characteristic characteristic) {
  return characteristic != Characteristic::Flatness &&
         characteristic != Characteristic::Roundness &&
         characteristic != Characteristic::Cylindricity &&
         characteristic != Characteristic::Position;
}

std::vector<MeasuredFeature> with_points(const Mesh& mesh,
                                         const std::vector<Feature>& features,
                                         const Run& run) {
  const FeaturePoints points = feature_points_of(mesh, run);
  std::vector<MeasuredFeature> measured;
  for (const Feature& feature : features) {
    MeasuredFeature one;
    one.feature = feature;
    for (const std::uint32_t vertex : feature.vertices) {
      one.points_mm.push_back(points.vertices.empty() ? points.points_mm.at(vertex)
                                                      : mesh.vertices_mm.at(vertex).cast<double>());
    }
    const Shape& shape = feature.fit.shape;
    for (const Vector3d& point : one.points_mm) {
      const double along = (point - shape.center_mm).dot(shape.axis);
      one.low_mm = std::min(one.low_mm, along);
      one.high_mm = std::max(one.high_mm, along);
    }
    measured.push_back(std::move(one));
  }
  return measured;
}

MeasuredValue measure(Characteristic characteristic,
                      const MeasuredFeature& feature,
                      const MeasuredFeature* datum,
                      const Vector3d& nominal_mm,
                      FormReference reference) {
  if (characteristic == Characteristic::Position) {
    const double distance = distance_between(shape_of(feature), nominal_mm);
    return {2.0 * distance, 2.0 * feature.feature.uncertainty.center_u95_mm};
  }
  if (!needs_datum(characteristic)) return form_of(characteristic, feature, reference);
  if (datum == nullptr) {
    throw Error(ErrorKind::Input,
                fmt::format("{} is relative to a datum; name one", name_of(characteristic)));
  }
  const ShapeUncertainty& u = feature.feature.uncertainty;
  const ShapeUncertainty& datum_u = datum->feature.uncertainty;
  if (characteristic == Characteristic::Distance) {
    const auto distance = [](const Shape& a, const Shape& b) { return distance_between(a, b); };
    return {distance(shape_of(feature), shape_of(*datum)),
            knows_calibration(u, datum_u)
                ? std::hypot(u.center_local_u95_mm,
                             datum_u.center_local_u95_mm,
                             calibration_u95(feature.feature, datum->feature, distance))
                : std::hypot(u.center_u95_mm, datum_u.center_u95_mm)};
  }
  if (characteristic == Characteristic::Angle) {
    if (!has_axis(shape_of(feature).kind)) refuse_kind(characteristic, shape_of(feature).kind);
    if (!has_axis(shape_of(*datum).kind)) refuse_kind(characteristic, shape_of(*datum).kind);
    const auto angle = [](const Shape& a, const Shape& b) {
      return std::atan2(a.axis.cross(b.axis).norm(), std::abs(a.axis.dot(b.axis)));
    };
    return {deg_from_rad(angle(shape_of(feature), shape_of(*datum))),
            deg_from_rad(knows_calibration(u, datum_u)
                             ? std::hypot(u.axis_local_u95_rad,
                                          datum_u.axis_local_u95_rad,
                                          calibration_u95(feature.feature, datum->feature, angle))
                             : std::hypot(u.axis_u95_rad, datum_u.axis_u95_rad))};
  }
  const bool turns =
      characteristic == Characteristic::RunOut || characteristic == Characteristic::TotalRunOut;
  return turns ? run_out_of(characteristic, feature, *datum)
               : orientation_of(characteristic, feature, *datum);
}

}  // namespace frangia
