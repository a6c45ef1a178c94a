#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

struct ScanView {
  double angle_rad = 0.0;        ///< commanded table angle
  std::filesystem::path folder;  ///< relative to the scan
  int setup = 0;  ///< views of one setup share one part pose of the part on the table
};

/// What scan.toml and rig.toml say: everything but the images.
struct Scan {
  std::filesystem::path folder;
  std::string name;
  Rig rig;
  std::vector<Pattern> patterns;  ///< in the order captured
  std::vector<ScanView> views;
  /// Roughly how the part stands in a setup, where that is known: what takes it from its place in
  /// setup 0, in the object frame.
  std::map<int, Eigen::Isometry3d> part_poses{};
};

/// A scan folder, as docs/scan-format.md describes it. Keys it does not know are warned of by name.
///
/// errors   Error(Input) that names the file and the key
[[nodiscard]] Scan read_scan(const std::filesystem::path& folder, const Run& run = {});

/// The `[[setup]]` tables of part_poses, as scan.toml has them.
[[nodiscard]] std::string toml_of(const std::map<int, Eigen::Isometry3d>& part_poses);

/// Writes scan.toml and rig.toml into `scan.folder`.
void write_scan(const Scan& scan);

/// PATTERN-FRAME.png, or PATTERN-FRAME@EXPOSURE.png of a pattern that is taken at several.
[[nodiscard]] std::string frame_file_name(const Pattern& pattern, int frame, int exposure = 0);

}  // namespace frangia
