#pragma once

#include <optional>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/geometry/mesh.h"
#include "frangia/reconstruct/check_silhouettes.h"
#include "frangia/reconstruct/internal/measure_views.h"

namespace frangia {

/// Compares a surface with the silhouettes in the frames without the projector's light, as the
/// reference camera saw them.
///
/// @missing  none when the scan has no such frames, or no background is lit
/// @errors   as read_frames; Error(Cancelled)
[[nodiscard]] std::optional<SilhouetteReport> silhouettes_of(const Scan& scan,
                                                             const MeasuredViews& measured,
                                                             const Mesh& mesh,
                                                             const Run& run);

}  // namespace frangia
