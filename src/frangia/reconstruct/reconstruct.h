#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decode_view.h"
#include "frangia/decode/decoded_views.h"
#include "frangia/decode/view_quality.h"
#include "frangia/fringe_order/correct_fringe_orders.h"
#include "frangia/fringe_order/resolve_by_views.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/indirect_light/indirect_correction.h"
#include "frangia/range/remove_mixed_pixels.h"
#include "frangia/reconstruct/check_silhouettes.h"
#include "frangia/reconstruct/finish_mesh.h"
#include "frangia/reconstruct/rig_agreement.h"
#include "frangia/reconstruct/setup_join.h"
#include "frangia/reconstruct/targets_report.h"
#include "frangia/registration/find_turntable_top.h"
#include "frangia/registration/refine_rig.h"
#include "frangia/registration/register_views.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Options of all stages from frames to mesh.
struct ReconstructOptions {
  DecodeOptions decode;            ///< frames to absolute phase
  MixedPixelOptions mixed_pixels;  ///< removal of pixels that see two surfaces
  /// Recheck of fringe orders after registration.
  FringeOrderCorrectionOptions fringe_order_correction;
  bool register_views = true;    ///< refine the turntable's axis and angles by the overlap of views
  RegisterOptions registration;  ///< refinement of axis and angles
  bool refine_rig = false;       ///< refines the rig itself by the surfaces of the views first
  /// Refines it, too, where the views decide that nothing else explains what they disagree about.
  bool explain_rig = true;
  RefineRigOptions refinement;      ///< prior of the rig's drift
  bool keep_turntable_top = false;  ///< otherwise it is found and removed
  bool keep_background = false;     ///< otherwise what stands still is found and removed
  double clip_below_mm =
      -std::numeric_limits<double>::infinity();  ///< removes points below this height, object frame
  double clip_radius_mm =
      std::numeric_limits<double>::infinity();  ///< removes points farther from the axis
  FusionOptions fusion;                         ///< fusion of the views
  FrameColors colors = FrameColors::Linear;     ///< of the vertices
  bool indirect_light = true;  ///< looks for indirect light, corrects it, counts the rest in sigma
  bool fill_targets = false;   ///< closes the mesh under the targets
  FinishOptions finish;        ///< hole filling and decimation
  bool keep_raw = false;       ///< returns the registered points, too
  /// Returns about this many registered points of each joined setup, too, where there are several.
  std::size_t keep_points_of_setups = 0;
  /// Views that were decoded, with the options of `decode`, while they were captured; null: none.
  /// The result has the same bytes with and without.
  std::shared_ptr<const DecodedViews> decoded;
};

/// What stands still in front of the cameras while the part turns, and was left out.
struct BackgroundReport {
  std::size_t points = 0;          ///< that were removed from all views; 0: nothing was found
  double from_axis_mm = kMissing;  ///< distance of the nearest ones from the axis; NaN: none
  double undecided = 0.0;          ///< see `Background`
};

/// The reconstructed surface and what the stages report.
struct Reconstruction {
  Mesh mesh;                 ///< fused surface, object frame; sigma is NaN if it is not trusted
  MedianSigma sigma;         ///< of the mesh's vertices
  PointCloud raw;            ///< empty unless `keep_raw`
  RemovedIslands islands{};  ///< components that are not in the mesh
  std::size_t points = 0;    ///< in all views
  std::size_t views = 0;     ///< that hold points
  std::vector<ViewSummary> view_summaries;         ///< of all views, in the order of the scan
  std::optional<RegistrationReport> registration;  ///< empty when not done
  std::vector<SetupJoin> setups;            ///< ordered by number; empty for a scan of one setup
  std::vector<PointCloud> setup_points{};   ///< of the joined ones of `setups`, in their order
  std::optional<RigRefinement> refinement;  ///< empty when not done
  double turntable_top_height_mm =
      std::numeric_limits<double>::quiet_NaN();  ///< NaN: none was removed
  BackgroundReport background{};                 ///< what stands still, and is left out
  /// How well points agree that were measured twice: by two directions of fringes, by two cameras.
  /// Empty for what no view measured. They check the rig.
  std::vector<RigAgreement> agreements{};
  std::size_t cameras = 1;                            ///< of the rig
  std::optional<IndirectLightReport> indirect_light;  ///< empty: none was found
  std::optional<SilhouetteReport> silhouettes{};      ///< empty where no background is lit
  std::optional<TargetsReport> targets{};             ///< empty for a scan without `[targets]`
  /// Why the mesh must not be trusted, as one clause without a full stop; empty when it can be.
  std::string untrusted_reason{};
};

/// Reconstructs a surface from a scan: frames, phase, range, registered views, fused mesh.
///
/// @units    mm, object frame
/// @missing  a view without a lit pixel is left out with a warning
/// @errors   Error(Numeric) when no view has a measured pixel, Error(Input) when the fringe orders
/// are
///           unknown or the points form no surface, and the errors of all stages
[[nodiscard]] Reconstruction reconstruct(const Scan& scan,
                                         const ReconstructOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
