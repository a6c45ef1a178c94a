#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/inspection/inspection_plan.h"

namespace frangia {

/// A row of the table of results.
struct MeasuredCharacteristic {
  std::string name;                       ///< of the plan, with the quantity
  std::optional<Characteristic> kind;     ///< none: a diameter
  std::string feature;                    ///< of the plan, or section; empty: the whole part
  std::string datum;                      ///< name of its datum; may be empty
  ShapeKind shape = ShapeKind::Plane;     ///< of the feature
  std::optional<FormReference> fit;       ///< of a form: what it is measured from
  std::string unit = "mm";                ///< mm or degrees
  std::optional<double> nominal;          ///< none: not stated
  double value = kMissing;                ///< NaN: the feature was not found
  double u95 = kMissing;                  ///< half the width of the 95 % interval
  bool uncertainty_known = true;          ///< false: the mesh states no sigma
  std::optional<ToleranceLimits> limits;  ///< of the value; an absent limit is infinite
  /// By ISO 14253-1; by the limits alone where the mesh states no sigma; undecided where the value
  /// is not known, its uncertainty cannot be determined or no limit is stated.
  Conformity conformity = Conformity::Undecided;
  /// Why a row with limits is not in, where value, interval and limits do not show it: a profile
  /// that was not measured everywhere, an uncertainty that is not known. Otherwise empty.
  std::string reason;
};

/// The feature of the planned kind whose center, or axis, and diameter come nearest to those of the
/// plan; null where none lies within `farthest_mm`.
[[nodiscard]] const Feature* nearest_feature(const PlannedFeature& planned,
                                             const std::vector<Feature>& features,
                                             double farthest_mm);

/// How far from its planned place and size a feature may be, as a share of the diagonal of the
/// part.
inline constexpr double kFarthestFeature = 0.1;

/// Decides about a row by its value, its uncertainty and its limits.
void decide(MeasuredCharacteristic& row);

/// Measures what a plan asks for on a mesh in the frame of its reference. A planned feature is the
/// one of its kind whose center, or axis, and diameter come nearest, within `kFarthestFeature` of
/// the diagonal of all points, unless that belongs to another planned feature that is nearer to it.
///
/// Those that are `is_of_surface` have no value yet: `measure_on_surface` measures them. `run` is
/// warned of planned features that are not found, and of those that may be another feature.
/// @units    mm, degrees
/// @missing  values of features that are not found are NaN
/// @errors   Error(Input) for a characteristic that the kind of its feature does not have
[[nodiscard]] std::vector<MeasuredCharacteristic> measure_characteristics(
    const InspectionPlan& plan, const std::vector<MeasuredFeature>& features, const Run& run = {});

/// A feature of a plan that was found.
struct NamedFeature {
  std::string name;              ///< in the plan
  Shape shape;                   ///< measured
  ShapeUncertainty uncertainty;  ///< of `shape`
  double low_mm = 0.0;           ///< ends of its points along its axis, from the center
  double high_mm = 0.0;          ///< see `low_mm`
  /// Vertices that it was fitted to, ascending; empty for lines and circles, and for a mesh whose
  /// vertices do not cover its surface.
  std::vector<std::uint32_t> vertices;
};

/// The features of a plan that were found, in the order of the plan.
[[nodiscard]] std::vector<NamedFeature> named_features(
    const InspectionPlan& plan, const std::vector<MeasuredFeature>& features);

/// The decision about all rows: out when one is out, in when all that have limits are in.
[[nodiscard]] Conformity overall(const std::vector<MeasuredCharacteristic>& rows);

}  // namespace frangia
