#pragma once

#include <string>

#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Stores a plan in `capture/` of its folder, or checks that it equals the plan stored there.
/// Removes the temporary files of a killed session. Returns whether a plan was stored before.
///
/// `options_text` describes the capture options, which must be the same in every session.
/// @errors   Error(Input) when the folder holds anything else; Error(File)
bool claim_folder(const Scan& plan, const std::string& options_text);

/// Writes scan.toml and rig.toml of the scan and syncs them to the disk.
void finish_folder(const Scan& scan);

}  // namespace frangia
