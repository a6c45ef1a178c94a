#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/pattern/pattern.h"
#include "frangia/range/drop_mixed_edges.h"
#include "frangia/scan/decode_view.h"
#include "frangia/scan/scan_folder.h"
#include "frangia/views/anchor_by_views.h"
#include "frangia/views/register_views.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Every view of a scan as a range grid, each by itself.
struct MeasuredViews {
  ViewStore views;
  std::vector<RegisteredView> stops;  ///< of the turntable, one a view
  std::vector<int> rounds;            ///< of the scan, one a view
  std::vector<LoosePart> loose;       ///< regions whose fringe their view cannot tell
  Pattern coarsest;                   ///< pattern that was decoded
  bool unwrapped_in_space = false;    ///< so that whole patches may be fringes off
  std::size_t points = 0;
};

/// Frames, phase, range: one view of the scan after the other.
///
/// missing  a view without a lit pixel is left out with a warning
/// errors   as read_frames and decode_view
[[nodiscard]] MeasuredViews measure_views(const Scan& scan,
                                          const Image<Eigen::Vector2f>& rays,
                                          const DecodeOptions& decode,
                                          const EdgeOptions& edges,
                                          const Run& run = {});

}  // namespace frangia
