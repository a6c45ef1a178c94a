#pragma once

#include <string>

#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Lays a plan down in its folder, in `capture/`, or makes sure that it is the one that lies there
/// already; takes away what a killed session left half written. Returns whether it lay there.
///
/// `options_text` is what else was asked for, in words, and must be the same again.
/// errors   Error(Input) when the folder holds something else; Error(File)
bool claim_folder(const Scan& plan, const std::string& options_text);

/// Writes the scan's own scan.toml and rig.toml, to outlive a power cut.
void finish_folder(const Scan& scan);

}  // namespace frangia
