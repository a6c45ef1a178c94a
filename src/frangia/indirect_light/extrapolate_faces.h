#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// Replaces depths that indirect light may have shifted by the faces that continue from reliable
/// pixels around them, and closes small gaps in the same way.
///
/// A prediction of indirect light needs the surface near a crease, where indirect light distorts it
/// most. Each reliable neighbourhood that is flat within its noise continues as a plane. Where
/// several meet, a concave edge takes the nearer one, a convex edge the farther one. A pixel
/// without a flat neighbourhood in reach keeps its depth.
///
/// @param range    of one view
/// @param most_mm  largest shift of a pixel's depth that is plausible; 0: reliable; NaN: no point
/// @param rays     of the camera
/// @shape    `most_mm` and `rays` as the grid
/// @units    mm
[[nodiscard]] Image<float> extrapolate_faces(const RangeGrid& range,
                                             const Image<float>& most_mm,
                                             const Image<Eigen::Vector2f>& rays);

}  // namespace frangia
