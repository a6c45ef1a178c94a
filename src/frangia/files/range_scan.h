#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// One range scan that another program made.
struct RangeScan {
  std::filesystem::path path;
  Mesh mesh;  ///< its points, in its own frame; triangles between neighbours, none of loose points
  Eigen::Isometry3d world_from_scan = Eigen::Isometry3d::Identity();
  bool posed = false;  ///< by a .conf; else the scan is in a frame that others may or may not share
};

/// A PLY: with faces, with Stanford's `range_grid` (`obj_info num_cols` and `num_rows`), whose
/// neighbours become triangles seen from +z, or of points alone.
///
/// units    as in the file, taken for mm
/// missing  empty places of the grid; no triangle spans a step of more than six times the spacing
/// errors   Error(Input) as read_ply, and when the grid does not hold what it says
/// source   Stanford 3D Scanning Repository: Curless & Levoy 1996
[[nodiscard]] RangeScan read_range_scan(const std::filesystem::path& path);

/// The scans that a `.conf` names, where it says: `bmesh FILE tx ty tz qx qy qz qw`. Its
/// quaternions are the conjugate of the scan's rotation.
///
/// errors   Error(Input) that names the line
[[nodiscard]] std::vector<RangeScan> read_posed_scans(const std::filesystem::path& path);

}  // namespace frangia
