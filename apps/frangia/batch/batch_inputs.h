#pragma once

#include "batch/batch_plan.h"
#include "batch/file_record.h"

namespace frangia {

/// The files that a result depends on, by names that tell them apart: scan.toml, rig.toml and every
/// frame of the scan, the script of the edits, and what the options of `inspect` name: the
/// reference and the plan with its reference. Files that are missing are among them.
[[nodiscard]] NamedFiles inputs_of(const BatchScan& scan);

/// The first frame that does not have the checksum of the scan's capture/manifest.txt, in a
/// sentence; empty when all have, or when there is no manifest.
[[nodiscard]] std::string differing_frame(const BatchScan& scan);

}  // namespace frangia
