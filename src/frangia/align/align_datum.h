#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/features/shape.h"
#include "frangia/features/shape_uncertainty.h"
#include "frangia/uncertainty/pose_uncertainty.h"

namespace frangia {

/// A datum of a drawing and the same element of a part, both surfaces of one kind.
struct Datum {
  std::string name;              ///< for messages
  Shape nominal;                 ///< in the frame of the reference
  Shape measured;                ///< on the part, near its nominal place
  ShapeUncertainty uncertainty;  ///< of the measured one
};

/// How far a datum of the aligned part is from its nominal place.
struct DatumResidual {
  std::string name;          ///< of the datum
  double angle_rad = 0.0;    ///< between the axes or normals; 0 for a sphere
  double distance_mm = 0.0;  ///< of the planes at the measured center, of the axes, of the centers
};

/// The result of an alignment to datums.
struct DatumAlignment {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  ///< moves the part onto the datums
  std::vector<DatumResidual> residuals;                      ///< after the motion, one for a datum
  /// Motions that the datums leave free, such as "translation along (0, 0, 1)"; the part was not
  /// moved along them.
  std::vector<std::string> free_directions;
  PoseUncertainty uncertainty;  ///< by the uncertainty of the datums
};

/// Aligns a part to up to three datums in their order: the first is met as its kind allows, the
/// second as far as the motions allow that keep the first, and so on (3-2-1). Of a cylinder and a
/// cone the axis is the datum, of a sphere its center, of a torus both.
///
/// @units    mm, rad; `center_mm` and `size_mm` are those of the part
/// @errors   Error(Input) that names a datum which determines nothing that those before it leave
///           free, or whose measured element is of another kind; for no datum or more than three
/// @source   ISO 5459; least squares in the null space of the datums before
[[nodiscard]] DatumAlignment align_to_datums(std::span<const Datum> datums,
                                             const Eigen::Vector3d& center_mm,
                                             double size_mm);

}  // namespace frangia
