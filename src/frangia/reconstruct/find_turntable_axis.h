#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/reconstruct/reconstruct.h"

namespace frangia {

/// The axis of a turntable, found from the views of a part that turned on it.
///
/// @units    mm, rad
struct AxisOfPart {
  Turntable table;    ///< with its standard deviations; the point is the nearest to the part
  std::size_t views;  ///< that the axis rests on
  double rms_mm;      ///< distance between the surfaces of different views
  std::vector<std::string> left_out;  ///< names of views that fit no other
};

/// Finds the axis of the turntable from a scan of any part, without a start: the views are put
/// together by their shape, the axis is the one about which they turned by their angles, and it is
/// registered with the surfaces of the views. What keeps its place in the views, as the top of the
/// turntable and round parts do, says nothing and is left out.
///
/// @shape    the views of the first setup count; a [turntable] of the rig is not used
/// @missing  views that fit no other, or in several poses, are left out
/// @errors   Error(Input) when fewer than three views have different angles, or fringe orders need
///          the axis; Error(Numeric) when the part does not show it; those of the stages
[[nodiscard]] AxisOfPart find_turntable_axis(const Scan& scan,
                                             const ReconstructOptions& options = {},
                                             const Run& run = {});

}  // namespace frangia
