#include "frangia/features/geometric_tolerance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/features/feature_points.h"
#include "frangia/features/filtered_range.h"
#include "frangia/features/internal/minimum_zone.h"
#include "frangia/features/internal/shape_distance_between.h"

namespace frangia {
namespace {

/// The width of a form and half the width of its 95 % interval, mm.
struct FormWidth {
  double value = 0.0;
  double u95 = 0.0;
};

/// The shape whose minimum zone is wanted, and what it may choose.
struct WantedZone {
  const Shape* shape = nullptr;  ///< null: the range of the values as they are
  ZoneFreedom freedom = ZoneFreedom::All;
};

/// The range of values without their noise. Of the distances from a shape whose minimum zone is
/// wanted, the width of that zone of the points without noise.
///
/// @errors   as filtered_range and minimum_zone_width
FormWidth form_width(std::vector<SurfaceValue> values, const WantedZone& zone = {}) {
  const FilteredRange range = filtered_range(std::move(values));
  if (zone.shape == nullptr) return {range.high - range.low, range.u95};
  std::vector<Eigen::Vector3d> points;
  points.reserve(range.values.size());
  for (const SurfaceValue& one : range.values) {
    const ShapeDistance at = distance_to(*zone.shape, one.point_mm);
    points.emplace_back(one.point_mm + (one.value - at.distance_mm) * at.normal);
  }
  return {minimum_zone_width(*zone.shape, points, zone.freedom), range.u95};
}

/// The largest such width in sections normal to an axis; few points in a section do not count.
FormWidth largest_section_width(const std::vector<SurfaceValue>& values,
                                const Eigen::Vector3d& center_mm,
                                const Eigen::Vector3d& axis,
                                const WantedZone& zone = {}) {
  constexpr std::size_t kSections = 24;
  constexpr std::size_t kLeast = 96;
  double low = 0.0;
  double high = 0.0;
  for (const SurfaceValue& one : values) {
    const double along = (one.point_mm - center_mm).dot(axis);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  const std::size_t count =
      std::clamp<std::size_t>(values.size() / (4 * kLeast), std::size_t{1}, kSections);
  std::vector<std::vector<SurfaceValue>> sections(count);
  for (const SurfaceValue& one : values) {
    const double share = ((one.point_mm - center_mm).dot(axis) - low) / std::max(high - low, 1e-12);
    const double at = share * static_cast<double>(count);
    sections[std::min(static_cast<std::size_t>(at), count - 1)].push_back(one);
  }
  FormWidth largest;
  for (auto& section : sections) {
    if (section.size() < kLeast && count > 1) continue;
    if (section.empty()) continue;
    const FormWidth width = form_width(std::move(section), zone);
    if (width.value >= largest.value) largest = width;
  }
  return largest;
}

/// Whether it is known what the calibration does to both features.
bool knows_calibration(const ShapeUncertainty& a, const ShapeUncertainty& b) {
  return a.calibration.size() > 0 && a.calibration.cols() == b.calibration.cols();
}

/// Half the width of the 95 % interval that the calibration of the rig gives a quantity of two
/// features: each change of its parameters moves both.
template <typename Value>
double calibration_u95(const Feature& feature, const Feature& datum, const Value& value) {
  const Eigen::MatrixXd& changes = feature.uncertainty.calibration;
  const Eigen::MatrixXd& datum_changes = datum.uncertainty.calibration;
  const double now = value(feature.fit.shape, datum.fit.shape);
  double square = 0.0;
  for (Eigen::Index i = 0; i < changes.cols(); ++i) {
    const double then = value(moved(feature.fit.shape, changes.col(i)),
                              moved(datum.fit.shape, datum_changes.col(i)));
    square += (then - now) * (then - now);
  }
  return kNormal95 * std::sqrt(square);
}

using Eigen::Vector3d;
using Kind = ShapeKind;

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

MeasuredValue measured(Characteristic characteristic,
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

}  // namespace

bool needs_datum(Characteristic characteristic) {
  return !is_form(characteristic) && !is_of_surface(characteristic) &&
         characteristic != Characteristic::Position;
}

bool is_form(Characteristic characteristic) {
  return characteristic == Characteristic::Flatness ||
         characteristic == Characteristic::Roundness ||
         characteristic == Characteristic::Cylindricity;
}

bool is_of_surface(Characteristic characteristic) {
  return characteristic == Characteristic::SurfaceProfile ||
         characteristic == Characteristic::LineProfile ||
         characteristic == Characteristic::Thickness;
}

bool has_nominal(Characteristic characteristic) {
  return characteristic == Characteristic::Distance || characteristic == Characteristic::Angle ||
         characteristic == Characteristic::Thickness;
}

std::vector<MeasuredFeature> with_points(const Mesh& mesh,
                                         const std::vector<Feature>& features,
                                         const Run& run) {
  const FeaturePoints points = feature_points_of(mesh, run);
  std::vector<MeasuredFeature> measured;
  for (const Feature& feature : features) {
    MeasuredFeature one;
    one.feature = feature;
    one.sampled = points.vertices.empty();
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
  MeasuredValue found = measured(characteristic, feature, datum, nominal_mm, reference);
  const bool is_known = feature.feature.uncertainty.is_known &&
                        (datum == nullptr || datum->feature.uncertainty.is_known);
  if (!is_known) found.u95 = kMissing;
  return found;
}

}  // namespace frangia
