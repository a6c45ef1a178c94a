#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decode_view.h"
#include "frangia/decode/decoded_views.h"
#include "frangia/decode/view_quality.h"
#include "frangia/fringe_order/resolve_by_views.h"
#include "frangia/indirect_light/estimate_albedo.h"
#include "frangia/pattern/pattern.h"
#include "frangia/range/depth_agreement.h"
#include "frangia/range/remove_mixed_pixels.h"
#include "frangia/registration/register_views.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// A pixel with a point, and what the frames of each fringe pattern measured there.
struct ShownFringes {
  int x = 0;
  int y = 0;
  std::vector<MeasuredFringe> measured;  ///< coarse to fine, of the direction of `coarsest`
};

/// Of one camera: some pixels of each view of the scan; none of a view without points.
using FringesOfViews = std::vector<std::vector<ShownFringes>>;

/// The range grids of all views of a scan.
struct MeasuredViews {
  /// The views of each camera of the rig, the reference camera first; one for each station.
  std::vector<ViewStore> cameras = std::vector<ViewStore>(1);
  std::vector<Station> stations;                 ///< of the turntable, one per view
  std::vector<int> setups;                       ///< setup numbers, one per view
  std::vector<UnresolvedViewRegion> unresolved;  ///< regions without a fringe order
  Pattern coarsest;                              ///< coarsest fringe pattern
  bool unwrapped_spatially = false;              ///< whole patches may then be wrong by fringes
  std::size_t points = 0;
  /// One per view in which points were measured by both directions of fringes, or by two cameras.
  std::vector<DepthAgreement> direction_agreements;
  std::vector<DepthAgreement> camera_agreements;
  Pattern first;  ///< of the phases of the two directions
  Pattern second;
  std::vector<std::string> corrections;  ///< of the phase of the first view, a clause for each
  std::vector<ViewSummary> summaries;    ///< of all views of the scan, also of those left out
  std::vector<FringesOfViews> fringes;   ///< by camera

  [[nodiscard]] const ViewStore& reference() const { return cameras.front(); }  ///< camera 0
  [[nodiscard]] ViewStore& reference() { return cameras.front(); }              ///< camera 0
};

/// Reads, decodes and triangulates all views of a scan. The next view is read and decoded while one
/// is triangulated, within the memory of two views. The cameras of a view are fused by
/// `fuse_cameras`; with a projector that is a label, `match_by_phase` finds their common points.
///
/// `known` holds views that were decoded before.
///
/// @shape    `rays` of the reference camera
/// @missing  a view without a lit pixel is left out with a warning, and so is a view whose frames
///           do not fit scan.toml or the rig, unless `accept_inconsistent` is set
/// @errors   as read_frames and decode_view; Error(Numeric) when no view fits
[[nodiscard]] MeasuredViews measure_views(const Scan& scan,
                                          const Image<Eigen::Vector2f>& rays,
                                          const DecodeOptions& decode,
                                          const MixedPixelOptions& mixed_pixels,
                                          const Run& run = {},
                                          const std::shared_ptr<const DecodedViews>& known = {});

/// The stations of some views. A rig with one camera is itself an explanation of what the views
/// disagree about; points of several cameras are not those of one drift.
[[nodiscard]] TurntableStations stations_of(const Rig& rig, const MeasuredViews& measured);

}  // namespace frangia
