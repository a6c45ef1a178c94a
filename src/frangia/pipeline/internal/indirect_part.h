#pragma once

#include <functional>
#include <optional>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/pipeline/indirect_light_report.h"
#include "frangia/pipeline/internal/measure_views.h"
#include "frangia/pipeline/internal/scan_decoding.h"

namespace frangia {

/// Indirect light that was found in a scan.
struct IndirectPart {
  /// Moves the points of a view to where they are without the predicted error of their phase, and
  /// removes those whose fringe order indirect light makes wrong. Points that two directions of
  /// fringes determine stay where they are. Correcting a view again replaces the correction.
  std::function<void(View&)> correct;
  /// Adds the uncertainty of the prediction to the systematic parts of a view's points.
  std::function<void(View&)> add;
  /// Largest shift of each point's depth that indirect light can cause; see IndirectCorrection.
  std::function<Image<float>(const View&)> largest_shifts_mm;
  double unexplained = 1.0;  ///< of the frames' indirect light; see AlbedoEstimate
  IndirectLightReport report;
};

/// Finds out whether a surface lights itself, and by how much.
///
/// The measured surface predicts where indirect light arrives, and which fringes it carries. Where
/// that is material, frames of up to three views are decoded again: contrast and phases give the
/// reflectance (`estimate_albedo`). Nothing is returned when they show no indirect light.
///
/// @shape    `surface` is the fused mesh of these views, object frame
/// @errors   as read_frames and decode_view; Error(Cancelled)
[[nodiscard]] std::optional<IndirectPart> indirect_part(const ScanDecoding& decoding,
                                                        const MeasuredViews& measured,
                                                        const Mesh& surface,
                                                        const Run& run);

}  // namespace frangia
