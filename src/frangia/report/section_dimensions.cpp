#include "frangia/report/section_dimensions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kAligned_rad = rad_from_deg(2.0);  // 0.06 % of a length: a section shows it true
constexpr double kThroughCenter = 0.03;             // of the radius: the chord is shorter by 0.05 %

Vector2d in_plane(const SectionPlane& plane, const Vector3d& point) {
  const Vector3d from = point - plane.point_mm;
  return {from.dot(plane.u), from.dot(plane.v)};
}

/// A value with as many decimals as its U95 has with two digits.
std::string value_text(const char* sign, double value, double u95) {
  if (!(u95 > 0.0)) return fmt::format("{}{:.3f}", sign, value);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(u95))), 0, 4);
  return fmt::format("{0}{1:.{3}f} ± {2:.{3}f}", sign, value, u95, decimals);
}

/// The ends of a diameter of a round feature in the plane; none where the plane does not show it.
/// `turn_rad` is the direction of the diameter of a circle.
std::optional<std::pair<Vector3d, Vector3d>> diameter_in(const SectionPlane& plane,
                                                         const NamedFeature& feature,
                                                         double turn_rad) {
  const Shape& shape = feature.shape;
  const double radius = shape.radius_mm;
  const double height = (shape.center_mm - plane.point_mm).dot(plane.normal);
  const Vector3d across = std::cos(turn_rad) * plane.u + std::sin(turn_rad) * plane.v;
  if (shape.kind == ShapeKind::Sphere) {
    if (std::abs(height) > kThroughCenter * radius) return std::nullopt;
    return std::pair(shape.center_mm - radius * across, shape.center_mm + radius * across);
  }
  if (shape.kind != ShapeKind::Cylinder) return std::nullopt;
  const double cosine = shape.axis.dot(plane.normal);
  if (std::abs(cosine) > std::cos(kAligned_rad)) {
    const double along = -height / cosine;  // to where the axis meets the plane
    if (along < feature.low_mm || along > feature.high_mm) return std::nullopt;
    const Vector3d center = shape.center_mm + along * shape.axis;
    return std::pair(center - radius * across, center + radius * across);
  }
  const double along = 0.5 * (feature.low_mm + feature.high_mm);
  const Vector3d center = shape.center_mm + along * shape.axis;
  const double off = (center - plane.point_mm).dot(plane.normal);
  if (std::abs(cosine) > std::sin(kAligned_rad) || std::abs(off) > kThroughCenter * radius)
    return std::nullopt;
  const Vector3d side = shape.axis.cross(plane.normal).normalized();
  return std::pair(center - radius * side, center + radius * side);
}

const NamedFeature* feature_of(const std::vector<NamedFeature>& features, const std::string& name) {
  const auto found = std::find_if(
      features.begin(), features.end(), [&](const NamedFeature& one) { return one.name == name; });
  return found == features.end() ? nullptr : &*found;
}

std::optional<Conformity> decision_of(const MeasuredCharacteristic& row) {
  return row.limits ? std::optional(row.conformity) : std::nullopt;
}

bool is_cut_at_right_angle(const SectionPlane& plane, const NamedFeature& feature) {
  return feature.shape.kind == ShapeKind::Plane &&
         std::abs(feature.shape.axis.dot(plane.normal)) < std::sin(kAligned_rad);
}

/// The distance of a plane from its datum, where the middle of the feature stands.
std::optional<SectionDimension> distance_in(const SectionPlane& plane,
                                            const std::vector<NamedFeature>& features,
                                            const MeasuredCharacteristic& row) {
  if (row.kind != Characteristic::Distance || !std::isfinite(row.value)) return std::nullopt;
  const NamedFeature* const feature = feature_of(features, row.feature);
  const NamedFeature* const datum = feature_of(features, row.datum);
  if (feature == nullptr || datum == nullptr || !is_cut_at_right_angle(plane, *feature) ||
      !is_cut_at_right_angle(plane, *datum))
    return std::nullopt;
  const Vector3d from = feature->shape.center_mm;
  const double distance = (from - datum->shape.center_mm).dot(datum->shape.axis);
  return SectionDimension{in_plane(plane, from),
                          in_plane(plane, from - distance * datum->shape.axis),
                          value_text("", row.value, row.u95),
                          decision_of(row)};
}

}  // namespace

std::vector<SectionDimension> section_dimensions(const SectionPlane& plane,
                                                 const std::vector<NamedFeature>& features,
                                                 const std::vector<MeasuredCharacteristic>& rows) {
  constexpr double kFirst_rad = rad_from_deg(35.0);
  constexpr double kNext_rad =
      rad_from_deg(55.0);  // so that concentric circles do not share a line
  std::vector<SectionDimension> dimensions;
  for (const NamedFeature& feature : features) {
    const double turn = kFirst_rad + kNext_rad * static_cast<double>(dimensions.size());
    const auto ends = diameter_in(plane, feature, turn);
    if (!ends) continue;
    SectionDimension dimension{in_plane(plane, ends->first), in_plane(plane, ends->second), {}, {}};
    double u95 = feature.uncertainty.u95_mm;
    for (const MeasuredCharacteristic& row : rows) {
      if (row.feature != feature.name || row.kind) continue;  // a diameter has no kind
      dimension.conformity = decision_of(row);
      u95 = row.u95;
    }
    dimension.text = value_text("⌀ ", 2.0 * feature.shape.radius_mm, u95);
    dimensions.push_back(std::move(dimension));
  }
  for (const MeasuredCharacteristic& row : rows) {
    if (auto distance = distance_in(plane, features, row))
      dimensions.push_back(*std::move(distance));
  }
  return dimensions;
}

}  // namespace frangia
