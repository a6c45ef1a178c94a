#pragma once

#include <string>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// The parts of a capture that must be the same in every session besides the plan, one per line.
struct SessionSettings {
  std::string options;  ///< capture options
  std::string devices;  ///< devices and their settings, see `describe_devices`
};

/// Stores a plan in `capture/` of its folder, or checks that it equals the plan stored there. The
/// names of the scan and of its folder may differ. A plan that has further views, or whose rig
/// knows the axis of its turntable, replaces the stored one. Removes the temporary files of a
/// killed session. The caller holds the lock of the folder.
///
/// @errors   Error(Input) when the folder holds anything else, naming the first difference;
///          Error(File)
void claim_folder(const Scan& plan, const SessionSettings& settings, const Run& run = {});

/// Writes rig.toml and scan.toml of the scan and syncs them to the disk.
void finish_folder(const Scan& scan);

}  // namespace frangia
