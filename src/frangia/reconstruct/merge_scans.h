#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/core/run.h"
#include "frangia/files/range_scan.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/reconstruct/finish_mesh.h"
#include "frangia/registration/find_view_poses.h"
#include "frangia/registration/register_poses.h"

namespace frangia {

/// The source of the scans' initial poses.
enum class ScanPoses {
  Auto,   ///< given poses if they are plausible or from a .conf file, else from shape
  Given,  ///< the poses of the files
  Shape   ///< pose search by shape alone
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(ScanPoses /*any*/) {
  return EnumNames<ScanPoses, 3>{
      {{ScanPoses::Auto, "auto"}, {ScanPoses::Given, "given"}, {ScanPoses::Shape, "shape"}}};
}

/// Options of the registration and fusion of range scans.
struct MergeScansOptions {
  ScanPoses poses = ScanPoses::Auto;  ///< source of the initial poses
  bool register_poses = true;         ///< refine the poses
  /// Share of a scan's compared points in front of another scan's surface, or behind it, beyond
  /// which the result is not trustworthy. Scans that fit stay below 0.04
  /// (tests/reconstruct/merge_scans_test).
  double max_contradiction = 0.1;
  /// Median distance between scans beyond which the result is not trustworthy: the larger of this
  /// many standard deviations of a scan's points ...
  double max_residual_sigmas = 10.0;
  double max_residual_spacings = 0.25;  ///< ... and this many distances of neighbouring points
  RegisterPosesOptions registration;    ///< refinement of the poses
  FusionOptions fusion;                 ///< fusion into one surface
  FinishOptions finish;                 ///< hole filling and decimation
};

/// Points of a range scan that its resampled view does not hold, by the reason.
struct DroppedPoints {
  std::size_t unconnected = 0;  ///< in no triangle: no neighbour within six spacings
  std::size_t hidden = 0;  ///< behind a nearer surface of the scan, or on a side seen from behind
  std::size_t too_dense = 0;  ///< nearer to another point than the pixels of the resampling

  /// Returns the number of all dropped points.
  [[nodiscard]] std::size_t total() const { return unconnected + hidden + too_dense; }
};

/// One of the scans that were merged.
struct MergedScan {
  std::string name;        ///< path of its file, or "scan 0" without one
  std::size_t points = 0;  ///< after resampling
  double noise_mm = 0.0;   ///< standard deviation of a point, from the scatter of neighbours
  bool left_out = false;   ///< its pose was not found
  /// It shares no surface with most of the others: its pose is the given one, and nothing verifies
  /// it.
  bool unverified = false;
  std::size_t points_read = 0;  ///< in the file
  DroppedPoints dropped{};      ///< why points of the file are not among those of the view
  double size_mm = 0.0;         ///< diagonal of the bounding box
  /// Refined pose; the given one for a scan that is left out.
  Eigen::Isometry3d world_from_scan = Eigen::Isometry3d::Identity();
};

/// The fused surface of several range scans and how they were registered.
struct MergedScans {
  Mesh mesh;                                ///< fused surface; sigma is NaN if it is not trusted
  std::vector<MergedScan> scans;            ///< in the order of the input
  RemovedIslands islands{};                 ///< components that are not in the mesh
  std::size_t points = 0;                   ///< of all resampled scans
  std::optional<FoundPoses> found_poses;    ///< set when poses were found by shape
  std::optional<PosesReport> registration;  ///< empty when the poses were not refined
  /// Largest share of a scan's compared points that violate the free space of the others.
  double contradiction = 0.0;
  /// Why the mesh must not be trusted, as one clause without a full stop; empty when it can be.
  std::string untrusted_reason{};
};

/// Registers range scans of other scanners and fuses them into one surface.
///
/// Each scan is resampled by a virtual camera that looks against its mean normal, with a pixel
/// pitch equal to the spacing of its points. Its noise is estimated from the scatter of neighbours.
/// @units    mm, in the frame of the given poses, or of the first scan when poses are found by
/// shape
/// @missing  a scan whose pose cannot be found is left out with a warning that names it
/// @errors   Error(Input) when a scan has no surface or no pose can be found, and those of
///          fuse_views
[[nodiscard]] MergedScans merge_scans(const std::vector<RangeScan>& scans,
                                      const MergeScansOptions& options = {},
                                      const Run& run = {});

}  // namespace frangia
