#pragma once

#include <filesystem>
#include <map>

#include <Eigen/Geometry>

#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Writes scan.toml and rig.toml into `scan.folder`. Each file appears complete or not at all.
///
/// @errors   Error(File) when a file cannot be written
void write_scan(const Scan& scan);

/// Writes part poses alone, as `[[setup]]` tables that can be appended to scan.toml.
///
/// @errors   Error(File) when the file cannot be written
void write_part_poses(const std::filesystem::path& path,
                      const std::map<int, Eigen::Isometry3d>& part_poses);

}  // namespace frangia
