#pragma once

#include "frangia/align/align_best_fit.h"

namespace frangia {

/// Refuses an alignment with less than the least overlap, or with clearly less than the mirror
/// image of the mesh or another unit would have, and says why the mesh does not lie on the
/// reference. `found` is its pose, `overlap` the share within `tolerance_mm`.
///
/// @errors   Error(Input) when it is refused
void refuse_alignment(const Mesh& mesh,
                      const RayScene& reference,
                      const BestFitOptions& options,
                      const Eigen::Isometry3d& found,
                      double overlap,
                      double tolerance_mm,
                      const Run& run);

}  // namespace frangia
