#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/reconstruct/merge_scans.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// How well the surfaces of registered scans agree.
struct MergeFit {
  /// Largest share of a scan's compared points that violate free space, over all scans.
  double contradiction = 0.0;
  std::size_t contradicting_scan = 0;  ///< the scan with that share
  /// Largest median distance of a scan from the others, over all scans.
  double residual_mm = 0.0;
  std::size_t residual_scan = 0;  ///< the scan with that distance
  /// Distance that noise and sampling explain: the largest acceptable `residual_mm`, and the margin
  /// of a free-space violation.
  double tolerance_mm = 0.0;
  /// Scans that share no surface with most of the others: nothing verifies their poses.
  std::vector<std::size_t> apart;
};

/// Noise and sampling of the worst scan.
struct ScanQuality {
  double noise_mm = 0.0;    ///< standard deviation of a point
  double spacing_mm = 0.0;  ///< distance of neighbouring points
};

/// Compares every two scans in their present poses. A scan that shares less than
/// `options.registration.min_overlap` of its points with the others is not assessed.
///
/// @shape    `maps`: one a view
[[nodiscard]] MergeFit compare_scans(const ViewStore& views,
                                     std::span<const SurfelMap> maps,
                                     const CameraModel& camera,
                                     const ScanQuality& quality,
                                     const MergeScansOptions& options);

/// Returns why the merged mesh must not be trusted, as one clause; empty when it can be.
///
/// @shape    `names`: one a view
[[nodiscard]] std::string untrusted_merge_reason(const MergeFit& fit,
                                                 std::span<const std::string> names,
                                                 const MergeScansOptions& options);

}  // namespace frangia
