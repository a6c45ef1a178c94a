#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/decode/check_view.h"
#include "frangia/decode/decode_view.h"
#include "frangia/range/fuse_directions.h"
#include "frangia/range/range_grid.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The points of a view and how far those of its two directions of fringes are apart.
struct TriangulatedView {
  RangeGrid range;                     ///< one point for each pixel
  DirectionDisagreement disagreement;  ///< without pixels for a view of one direction
};

/// Triangulates the directions of fringes that fit, of which there is one at least, and combines
/// them as `directions` says.
///
/// @shape    `rays` as rays_of(rig.reference().model)
/// @units    mm, rig frame
/// @missing  as `triangulate` and `fuse_directions`; the status of the leading direction's phase
///           gives the reason
[[nodiscard]] TriangulatedView triangulate_view(DecodedView& decoded,
                                                const ViewFit& fit,
                                                const Rig& rig,
                                                const Image<Eigen::Vector2f>& rays,
                                                DirectionChoice directions);

}  // namespace frangia
