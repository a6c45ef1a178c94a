#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frangia {

/// One scan of a batch and what is done with it.
struct BatchScan {
  std::string name;                      ///< of its folder in the output
  std::filesystem::path folder;          ///< the scan
  std::vector<std::string> reconstruct;  ///< options of `frangia reconstruct`
  std::filesystem::path edit;            ///< a script of `frangia edit`; empty: none
  std::vector<std::string> inspect;      ///< options of `frangia inspect`; empty: none
};

/// The scans of a batch.
struct BatchPlan {
  std::vector<BatchScan> scans;                ///< in the order of the table, with distinct names
  std::vector<std::string> formats = {"ply"};  ///< extensions of the meshes
};

/// Reads a plan:
///
///     format = "frangia-batch"
///     version = 1
///     scans = "scans"                  # a folder of scans, and/or [[scan]]
///     formats = ["ply", "dxf"]
///     reconstruct = ["--voxel", "0.3mm"]
///     edit = "repair.json"
///     inspect = ["--reference", "nominal.stl"]
///     [[scan]]
///     folder = "more/left-blade"
///     name = "left-blade"              # default: the folder's name
///     reconstruct = ["--clip-below", "2mm"]    # after those of all
///
/// A folder instead of a file is a plan of the scans in it: its folders with a scan.toml, by name.
/// Paths are relative to the plan; in `reconstruct` and `inspect`, to the place of the command.
///
/// @errors   Error(Input) that names the file and the key: a missing folder, two scans of one name,
///           no scan at all, an unknown key
[[nodiscard]] BatchPlan read_batch_plan(const std::filesystem::path& path);

}  // namespace frangia
