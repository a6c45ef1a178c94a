#pragma once

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

struct RemoveSpikesOptions {
  /// A vertex is a spike when the angles of its triangles there add up to less than this: 360 on a
  /// plane, 270 at the corner of a cube, 180 at the tip of a cone of 60 degrees.
  double below_rad = rad_from_deg(180.0);
  int iterations = 10;  ///< spikes of several vertices go down one after the other
};

/// The mesh with the tips of spikes set down on the mean of their neighbours, and marked as moved.
///
/// missing  a tip on the boundary stays, unless it is a needle: a twelfth as sharp and longer than
///          two mean edges. Such a one goes with its triangles
[[nodiscard]] Mesh remove_spikes(Mesh mesh,
                                 const RemoveSpikesOptions& options = {},
                                 const Run& run = {});

}  // namespace frangia
