#pragma once

#include <optional>

#include "frangia/core/run.h"
#include "frangia/decode/scan_decoding.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/indirect_light/indirect_light_report.h"
#include "frangia/reconstruct/internal/measure_views.h"

namespace frangia {

/// Counts the indirect light that the fused surface of several cameras predicts in the sigma of the
/// points of every camera, and fuses the views again. Points stay where they are, because the
/// phases of several cameras determine them: the whole predicted error enters sigma. `fusion` gets
/// this systematic part. Warns where indirect light matters; returns nothing where there is none.
///
/// @shape    `decoding`: of the reference camera, with a scan of all cameras
/// @errors   as fuse_views and indirect_part
[[nodiscard]] std::optional<IndirectLightReport> count_indirect_light(FusedSurface& fused,
                                                                      const MeasuredViews& measured,
                                                                      const ScanDecoding& decoding,
                                                                      FusionOptions& fusion,
                                                                      const Run& run);

}  // namespace frangia
