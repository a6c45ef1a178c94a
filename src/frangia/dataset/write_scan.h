#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <Eigen/Geometry>

#include "frangia/core/durable_file.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Returns the text of scan.toml.
[[nodiscard]] std::string scan_text(const Scan& scan);

/// Writes rig.toml and then scan.toml into `scan.folder`. Each file appears complete or not at all.
///
/// @errors   Error(File) when a file cannot be written
void write_scan(const Scan& scan, Durability durability = Durability::Buffered);

/// Writes part poses alone, as `[[setup]]` tables that can be appended to scan.toml.
///
/// @errors   Error(File) when the file cannot be written
void write_part_poses(const std::filesystem::path& path,
                      const std::map<int, Eigen::Isometry3d>& part_poses);

}  // namespace frangia
