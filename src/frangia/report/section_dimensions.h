#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/inspect/section_curves.h"
#include "frangia/inspection/measured_characteristics.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// A measured size that a section shows, between two points of the section.
struct SectionDimension {
  Eigen::Vector2d from_mm = Eigen::Vector2d::Zero();  ///< coordinates in the plane
  Eigen::Vector2d to_mm = Eigen::Vector2d::Zero();    ///< see `from_mm`
  std::string text;                                   ///< value and U95, a diameter with its sign
  std::optional<Conformity> conformity;               ///< none: no limits are stated
};

/// The sizes that a plane shows in true length: diameters of cylinders that it cuts across or along
/// their axis and of spheres that it cuts through their center, and distances between planes that
/// it cuts at a right angle. The values are those of the fitted features, not of the curves.
///
/// @shape    in the order of the features, then of the rows
/// @units    mm
[[nodiscard]] std::vector<SectionDimension> section_dimensions(
    const SectionPlane& plane,
    const std::vector<NamedFeature>& features,
    const std::vector<MeasuredCharacteristic>& rows);

}  // namespace frangia
