#pragma once

#include <optional>

#include "frangia/core/run.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/indirect_light/indirect_light_report.h"
#include "frangia/reconstruct/internal/indirect_part.h"
#include "frangia/reconstruct/internal/measure_views.h"

namespace frangia {

/// Counts the indirect light that a coarse surface of the views of several cameras predicts in the
/// sigma of the points of every camera. Points stay where they are, because the phases of several
/// cameras determine them: the whole predicted error enters sigma. `fusion` gets this systematic
/// part. Warns where indirect light matters; returns nothing where there is none.
///
/// @errors   as indirect_part
[[nodiscard]] std::optional<IndirectLightReport> count_indirect_light(const MeasuredViews& measured,
                                                                      const LitScan& lit,
                                                                      FusionOptions& fusion,
                                                                      const Run& run);

}  // namespace frangia
