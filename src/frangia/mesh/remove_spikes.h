#pragma once

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// What counts as a spike.
struct RemoveSpikesOptions {
  /// A vertex is a spike when the angles of its triangles at it add up to less than this. The sum
  /// is 360 degrees on a plane, 270 at a corner of a cube and 180 at the tip of a 60 degree cone.
  double below_rad = rad_from_deg(180.0);
  int iterations = 10;  ///< a spike of several vertices takes several iterations
};

/// Moves the tips of spikes to the mean of their neighbours and marks them as displaced.
///
/// A spike on a boundary stays, unless it is a needle: its angles add up to less than a twelfth of
/// `below_rad` and its edges are longer than twice the mean edge. The triangles of a needle are
/// removed.
///
/// @errors   Error(Cancelled)
[[nodiscard]] Mesh remove_spikes(Mesh mesh,
                                 const RemoveSpikesOptions& options = {},
                                 const Run& run = {});

}  // namespace frangia
