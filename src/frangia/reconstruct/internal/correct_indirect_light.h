#pragma once

#include <optional>

#include "frangia/core/run.h"
#include "frangia/decode/scan_decoding.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/indirect_light/indirect_light_report.h"
#include "frangia/reconstruct/internal/measure_views.h"

namespace frangia {

/// What was found out about the indirect light of a scan before its registration.
struct EarlyIndirectLight {
  bool found = true;  ///< false: it was looked for and not found
  /// False: the correction made the views rougher, and they stay as they were measured.
  bool corrects = true;
};

/// Corrects views that are not registered yet by the indirect light that a coarse surface predicts.
/// Otherwise views of a concave part contradict the others. A correction that makes the views
/// rougher is taken back.
///
/// @errors   as fuse_views and indirect_part
[[nodiscard]] EarlyIndirectLight correct_before_registration(MeasuredViews& measured,
                                                             const ScanDecoding& decoding,
                                                             FusionOptions coarse,
                                                             const Run& run);

/// Corrects the views by the indirect light that the fused surface predicts, and fuses them again;
/// twice, because the corrected surface predicts better, unless the first correction is small. A
/// correction that makes the views rougher is taken back, up to that before the registration, and
/// all of the predicted error is counted. `fusion` gets the systematic part of the prediction.
/// Warns where indirect light matters; returns nothing where there is none.
///
/// @errors   as fuse_views and indirect_part
[[nodiscard]] std::optional<IndirectLightReport> correct_indirect_light(
    FusedSurface& fused,
    MeasuredViews& measured,
    const ScanDecoding& decoding,
    const EarlyIndirectLight& before,
    FusionOptions& fusion,
    const Run& run);

}  // namespace frangia
