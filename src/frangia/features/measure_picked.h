#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/enum_names.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/features/find_features.h"
#include "frangia/features/shape.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// What someone measures by pointing at a surface.
enum class PickedQuantity {
  Distance,   ///< between two points or faces
  Angle,      ///< of two faces, 0 to 90 degrees, or at the second of three points
  Diameter,   ///< of a cylinder, sphere or cone at its middle; of the middle circle of a torus
  Thickness,  ///< from a point along the inward normal to the opposite wall
  Area,       ///< of the selected triangles, or of all
  Volume      ///< of a closed surface
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(PickedQuantity /*any*/) {
  return EnumNames<PickedQuantity, 6>{{{PickedQuantity::Distance, "distance"},
                                       {PickedQuantity::Angle, "angle"},
                                       {PickedQuantity::Diameter, "diameter"},
                                       {PickedQuantity::Thickness, "thickness"},
                                       {PickedQuantity::Area, "area"},
                                       {PickedQuantity::Volume, "volume"}}};
}

/// The unit in files: mm, degrees, mm2 or mm3.
[[nodiscard]] std::string_view unit_of(PickedQuantity quantity);

/// Where someone points at.
struct PickedPlace {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< in the frame of the mesh
  std::uint32_t triangle = 0;                          ///< of the mesh, on which the point lies
  bool face = false;  ///< the whole face there is meant: plane, cylinder, sphere, cone or torus
};

/// A point, or the face that was found there.
struct PickedElement {
  bool face = false;                                   ///< whether `feature` is a face
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< that was pointed at
  Feature feature;  ///< a point is a sphere of radius 0, whose center has the sigma of the point
};

/// A measurement, with what it is between.
struct PickedMeasurement {
  PickedQuantity quantity = PickedQuantity::Distance;  ///< what was measured
  double value = 0.0;                                  ///< in `unit_of(quantity)`
  double u95 = kMissing;                               ///< half the width of the 95 % interval
  std::vector<PickedElement> elements;                 ///< empty for an area and a volume
  bool of_selection = false;                           ///< an area of the selected triangles alone
  /// Ends of the line whose length is a distance, a diameter or a thickness, or that joins the
  /// elements of an angle; both are the center of an area and a volume.
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_mm = Eigen::Vector3d::Zero();  ///< see `from_mm`
};

/// Measures between places of a surface. Faces are those of `features_at`.
///
/// `selection` counts for an area alone.
/// @units    as unit_of
/// @missing  U95 is NaN where no sigma is known
/// @errors   Error(Input) for another number of places than the quantity takes, a face that is none
///           or has no such quantity, a place on a triangle that does not exist, a wall that is
///           open, or a volume of an open surface; Error(Cancelled)
[[nodiscard]] PickedMeasurement measure_picked(const Mesh& mesh,
                                               PickedQuantity quantity,
                                               std::span<const PickedPlace> places,
                                               const Selection& selection = {},
                                               const Run& run = {});

}  // namespace frangia
