#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// One range scan from another program.
struct RangeScan {
  std::filesystem::path path;  ///< file that the scan was read from
  Mesh mesh;  ///< in the scan's own frame; without triangles when the file holds loose points
  /// Pose of the scan; the identity when no .conf file gave one.
  Eigen::Isometry3d world_from_scan = Eigen::Isometry3d::Identity();
  bool posed = false;  ///< whether a .conf file gave the pose
};

/// Reads a scan as `read_mesh` does: triangles, Stanford's `range_grid` in a PLY (`obj_info
/// num_cols` and `num_rows`), whose neighbours are connected by triangles that face +z, or points
/// alone.
///
/// @units    as in the file, assumed to be mm where the format states none
/// @missing  empty cells of the grid; no triangle has an edge longer than six times the median
///           spacing of neighbours
/// @errors   Error(Input) as read_mesh, and when the grid does not match its stated size
/// @source   Stanford 3D Scanning Repository; Curless & Levoy 1996
[[nodiscard]] RangeScan read_range_scan(const std::filesystem::path& path,
                                        const Run& run = {},
                                        const ReadOptions& options = {});

/// Reads the scans that a Stanford `.conf` file lists, with their poses: each line is `bmesh FILE
/// tx ty tz qx qy qz qw`, whose quaternion is the conjugate of the scan's rotation.
///
/// @units    translations as in the scans, assumed to be mm
/// @errors   Error(Input) that names the file and the line, or the memory that the scans need when
///          `options` allow less
[[nodiscard]] std::vector<RangeScan> read_posed_scans(const std::filesystem::path& path,
                                                      const ReadOptions& options = {},
                                                      const Run& run = {});

/// Scales a scan and the translation of its pose, as to convert metres to millimetres.
void scale_range_scan(RangeScan& scan, double factor);

/// Writes a `.conf` that lists scans with their poses, as `read_posed_scans` reads it. Paths are
/// relative to the folder of the `.conf`.
///
/// @units    translations times `units_per_mm`: 0.001 for scans in metres
/// @errors   Error(File) when it cannot be written; Error(Input) when a path holds a blank, which
///          the format cannot state
void write_posed_scans(const std::filesystem::path& path,
                       const std::vector<RangeScan>& scans,
                       double units_per_mm = 1.0);

}  // namespace frangia
