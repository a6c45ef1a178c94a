#pragma once

#include <cstddef>

#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/acquisition/internal/set_files.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Lists stored frames again whose lines in the manifest are damaged. A frame counts if its PNG
/// decodes completely, each part of which has a CRC-32, and has the size of the rig's camera.
/// Frames of a set that was rejected for motion do not count. Returns the number of frames.
///
/// @errors   Error(File) when the manifest cannot be written
std::size_t recover_frames(const Scan& plan, const SetFiles& files, CaptureManifest& manifest);

}  // namespace frangia
