#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/decode/scan_decoding.h"
#include "frangia/geometry/mesh.h"
#include "frangia/indirect_light/estimate_albedo.h"
#include "frangia/indirect_light/indirect_light_report.h"
#include "frangia/reconstruct/internal/measure_views.h"

namespace frangia {

/// The views of a camera in which indirect light is looked for.
struct LitViews {
  const ViewStore& views;
  std::vector<std::size_t> of_scan;  ///< the view of the scan that each one is
  FringeDirection direction;         ///< of the fringes of which the points have a phase
};

/// The views of the reference camera, or of a further one.
[[nodiscard]] LitViews lit_views(const MeasuredViews& measured,
                                 const Scan& scan,
                                 std::size_t camera = 0);

/// What the frames of views show at some pixels. The views that several predictions ask for are
/// decoded once.
class ShownFringes {
 public:
  /// A pixel and what was measured there.
  struct AtPixel {
    int x = 0;
    int y = 0;
    std::vector<MeasuredFringe> measured;  ///< coarse to fine
  };
  /// Those of view `index` of the scan, of the fringes of a direction.
  ///
  /// @errors   as read_frames and decode_view
  [[nodiscard]] const std::vector<AtPixel>& of_view(const ScanDecoding& decoding,
                                                    std::size_t index,
                                                    const DirectionPlan& plan,
                                                    const Image<float>& depth_mm,
                                                    const Run& run);

 private:
  std::map<std::size_t, std::vector<AtPixel>> views_;  ///< by their index in the scan
};

/// What becomes of the points that indirect light shifts.
enum class ShiftedPoints {
  Moved,  ///< to where they are without the predicted error; sigma counts what may remain
  Kept    ///< other phases determine them, too: sigma counts all of the error
};

/// Indirect light that was found in the views of a camera.
struct IndirectPart {
  /// Moves the points of a view to where they are without the predicted error of their phase, and
  /// removes those whose fringe order indirect light makes wrong; nothing where points are kept.
  /// Correcting a view again replaces the correction.
  std::function<void(View&)> correct;
  /// Uncertainty of the prediction for each point of a view.
  std::function<Image<float>(const View&)> systematic_mm;
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
/// @shape    `shown`: of the same camera; `surface` is the fused mesh of the views, object frame;
/// `decoding`: of their camera
/// @errors   as read_frames and decode_view; Error(Cancelled)
[[nodiscard]] std::optional<IndirectPart> indirect_part(const ScanDecoding& decoding,
                                                        const LitViews& lit,
                                                        const Mesh& surface,
                                                        ShiftedPoints points,
                                                        ShownFringes& shown,
                                                        const Run& run);

}  // namespace frangia
