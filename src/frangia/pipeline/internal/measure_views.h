#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/fringe_order/resolve_by_views.h"
#include "frangia/pattern/pattern.h"
#include "frangia/pipeline/decode_view.h"
#include "frangia/range/remove_mixed_pixels.h"
#include "frangia/registration/register_views.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Every view of a scan as a range grid, each by itself.
struct MeasuredViews {
  ViewStore views;
  std::vector<Station> stations;                 ///< of the turntable, one a view
  std::vector<int> setups;                       ///< of the scan, one a view
  std::vector<UnresolvedViewRegion> unresolved;  ///< regions whose fringe their view cannot tell
  Pattern coarsest;                              ///< pattern that was decoded
  bool unwrapped_spatially = false;              ///< so that whole patches may be fringes off
  std::size_t points = 0;
};

/// Frames, phase, range: one view of the scan after the other.
///
/// missing  a view without a lit pixel is left out with a warning
/// errors   as read_frames and decode_view
[[nodiscard]] MeasuredViews measure_views(const Scan& scan,
                                          const Image<Eigen::Vector2f>& rays,
                                          const DecodeOptions& decode,
                                          const MixedPixelOptions& mixed_pixels,
                                          const Run& run = {});

}  // namespace frangia
