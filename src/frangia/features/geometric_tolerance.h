#pragma once

#include <string_view>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/features/find_features.h"

namespace frangia {

/// Geometrical characteristics of a feature, some of them relative to a datum.
enum class Characteristic {
  Flatness,          ///< of a plane
  Roundness,         ///< of a cylinder, cone or sphere: the largest of sections normal to its axis
  Cylindricity,      ///< of a cylinder
  Parallelism,       ///< of a plane or an axis to a datum
  Perpendicularity,  ///< of a plane or an axis to a datum
  Position,          ///< twice the distance from the nominal position
  RunOut,            ///< circular, the largest of the sections normal to the datum axis
  TotalRunOut,       ///< of the whole surface about the datum axis
  Distance,          ///< from a datum, between centers, axes or planes
  Angle,             ///< between the axes or normals of feature and datum, 0 to 90 degrees
  SurfaceProfile,    ///< twice the largest deviation from the nominal surface
  LineProfile,       ///< the same along a section
  Thickness          ///< of the walls
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(Characteristic /*any*/) {
  return EnumNames<Characteristic, 13>{{{Characteristic::Flatness, "flatness"},
                                        {Characteristic::Roundness, "roundness"},
                                        {Characteristic::Cylindricity, "cylindricity"},
                                        {Characteristic::Parallelism, "parallelism"},
                                        {Characteristic::Perpendicularity, "perpendicularity"},
                                        {Characteristic::Position, "position"},
                                        {Characteristic::RunOut, "run-out"},
                                        {Characteristic::TotalRunOut, "total-run-out"},
                                        {Characteristic::Distance, "distance"},
                                        {Characteristic::Angle, "angle"},
                                        {Characteristic::SurfaceProfile, "surface-profile"},
                                        {Characteristic::LineProfile, "line-profile"},
                                        {Characteristic::Thickness, "thickness"}}};
}

/// The shape that a form is measured from.
enum class FormReference {
  LeastSquares,  ///< the shape of least squares
  MinimumZone    ///< the shape with the narrowest zone, the minimum requirement of ISO 1101
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(FormReference /*any*/) {
  return EnumNames<FormReference, 2>{{{FormReference::LeastSquares, "least-squares"},
                                      {FormReference::MinimumZone, "minimum-zone"}}};
}

/// Whether a characteristic is relative to a datum.
[[nodiscard]] bool needs_datum(Characteristic characteristic);

/// Whether a characteristic is the form of a feature by itself, measured from a `FormReference`.
[[nodiscard]] bool is_form(Characteristic characteristic);

/// Whether a characteristic is of the surface or its walls, and not of the shape of a feature:
/// `measure` does not know it.
[[nodiscard]] bool is_of_surface(Characteristic characteristic);

/// Whether a characteristic has a nominal value with a tolerance, and not an upper limit.
[[nodiscard]] bool has_nominal(Characteristic characteristic);

/// A feature, and the points that it was fitted to.
struct MeasuredFeature {
  Feature feature;                         ///< shape and uncertainty
  std::vector<Eigen::Vector3d> points_mm;  ///< of a surface; empty for lines and circles
  /// Ends of the points along the axis, from the center, mm; 0 without points.
  double low_mm = 0.0;
  double high_mm = 0.0;  ///< see `low_mm`
  bool sampled = false;  ///< the vertices of the feature are samples, not those of the mesh
};

/// Adds the points of the mesh to its features.
///
/// @errors   Error(Input) as feature_points_of
[[nodiscard]] std::vector<MeasuredFeature> with_points(const Mesh& mesh,
                                                       const std::vector<Feature>& features,
                                                       const Run& run = {});

/// The two points whose distance is that of two shapes.
struct ShapeEnds {
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();  ///< on the shape, or its center or axis
  Eigen::Vector3d to_mm = Eigen::Vector3d::Zero();    ///< likewise, of the datum
};

/// Between which points the distance of two shapes is: from the center of the first along the
/// normal of a plane; along the common perpendicular of two axes; between centers.
///
/// @units    mm
[[nodiscard]] ShapeEnds ends_between(const Shape& shape, const Shape& datum);

/// A measured characteristic.
struct MeasuredValue {
  double value = 0.0;  ///< mm; degrees for an angle
  double u95 = 0.0;    ///< half the width of its 95 % interval; NaN where no sigma is stated
};

/// Measures a characteristic. Forms are ranges of the distances from the least-squares shape; noise
/// is removed by linear functions in blocks of about 64 points. An axis counts over the length of
/// its points. `reference` counts for flatness, roundness and cylindricity; a minimum zone has the
/// uncertainty of the range from the least-squares shape, which is an upper bound.
///
/// `nominal_mm` is the true position, for `Position` alone.
/// @units    mm, degrees
/// @errors   Error(Input) when the kind of the feature or of the datum has no such characteristic,
///           or the datum is missing
/// @source   ISO 1101:2017; ISO 12181-1, ISO 12180-1, ISO 12781-1
[[nodiscard]] MeasuredValue measure(Characteristic characteristic,
                                    const MeasuredFeature& feature,
                                    const MeasuredFeature* datum = nullptr,
                                    const Eigen::Vector3d& nominal_mm = Eigen::Vector3d::Zero(),
                                    FormReference reference = FormReference::LeastSquares);

}  // namespace frangia
