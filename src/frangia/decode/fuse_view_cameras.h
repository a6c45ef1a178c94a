#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/decode/check_view.h"
#include "frangia/decode/decode_view.h"
#include "frangia/range/fuse_cameras.h"
#include "frangia/range/fuse_directions.h"
#include "frangia/range/range_grid.h"
#include "frangia/range/remove_mixed_pixels.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A view as one camera recorded it.
struct DecodedCamera {
  const Rig& rig;                      ///< `rig_of_camera`
  const Image<Eigen::Vector2f>& rays;  ///< of its pixels
  DecodedView decoded;                 ///< its phases
  ViewFit fit{};                       ///< which of its phases are used

  /// The status of its pixels.
  [[nodiscard]] Image<PixelStatus>& status() {
    return decoded.directions[fit.leading()].phase.status;
  }
};

/// The points of a view in the frame of one camera.
struct MeasuredCamera {
  RangeGrid range;                      ///< its points
  std::vector<RangePixel> edge_pixels;  ///< as recover_edge_pixels
};

/// The points of a view.
struct MeasuredView {
  std::vector<MeasuredCamera> cameras;  ///< the reference camera first
  DirectionDisagreement directions;     ///< of the reference camera
  CameraDisagreement between_cameras;   ///< without pixels for one camera
};

/// Triangulates a view from the phases of all cameras and removes mixed pixels.
///
/// Each camera and the projector give a range grid, and `fuse_cameras` combines them. With a
/// projector that is a label, the grids come from `match_by_phase` alone. In `decoded`, the status
/// of pixels without a point becomes the reason.
///
/// @shape    `cameras` and the result in the order of the rig, the reference camera first
/// @missing  the grid of a camera whose phases are not used has no points
[[nodiscard]] MeasuredView fuse_view_cameras(const Rig& rig,
                                             std::span<DecodedCamera> cameras,
                                             DirectionChoice directions,
                                             const MixedPixelOptions& mixed_pixels,
                                             const Run& run = {});

}  // namespace frangia
