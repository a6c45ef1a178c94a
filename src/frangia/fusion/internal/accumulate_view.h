#pragma once

#include <cstddef>

#include "frangia/core/image.h"
#include "frangia/fusion/fusion_parameters.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/local_fit/local_planes.h"

namespace frangia {

struct HermiteOptions {
  double near_mm = 0.0;        ///< a view's surface farther from a crossing is another surface
  double free_space_mm = 0.0;  ///< a view's surface farther behind a crossing votes against it
  HermiteParameters parameters;
};

/// The systematic parts of a view's points along their rays.
struct SystematicImages {
  const Image<float>& all_mm;        ///< combined; empty: none is known
  const Image<float>& differing_mm;  ///< the share that differs by view; empty: none does
};

/// Samples one view at every crossing and adds its position and normal, or its vote for free space.
///
/// A view votes for free space only when it observes free space all around the pixel: next to a
/// silhouette, a small error of the pose looks like free space. `number` is that of the view, for
/// the weights.
void accumulate_view(HermiteAccumulators& hermite,
                     const EdgeCrossings& crossings,
                     const LocalPlanes& view,
                     const CameraRays& camera,
                     const HermiteOptions& options,
                     const SystematicImages& systematic,
                     std::size_t number = 0);

}  // namespace frangia
