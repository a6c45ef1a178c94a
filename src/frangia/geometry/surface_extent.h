#pragma once

#include <Eigen/Core>

#include "frangia/core/missing.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// An area or a volume of a mesh.
struct SurfaceExtent {
  double value = 0.0;   ///< mm^2 or mm^3
  double u = kMissing;  ///< standard uncertainty, likewise; NaN where no sigma is known
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< of the area
};

/// The area of the selected triangles, or of all where nothing is selected.
///
/// Vertices move along their normals. Their noise is independent; their systematic parts count as
/// one error that is alike in all of them. The border of a selection is taken as it is.
/// @shape    `selection` has one flag for each triangle, or is empty: all
/// @units    mm^2
/// @missing  a vertex whose sigma is not finite counts as the median one
[[nodiscard]] SurfaceExtent area_of(const Mesh& mesh, const Selection& selection = {});

/// The volume that a closed mesh encloses, with the uncertainty as `area_of` has it.
///
/// @units    mm^3
/// @missing  as area_of
/// @errors   Error(Input) for a mesh with a hole
[[nodiscard]] SurfaceExtent volume_of(const Mesh& mesh);

}  // namespace frangia
