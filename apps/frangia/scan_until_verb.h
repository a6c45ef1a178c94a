#pragma once

#include <filesystem>

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/folder_lock.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/rig_devices.h"

#include "terminal.h"

namespace frangia {

/// Captures `plan`, and further stations until the inspection by a plan is decided, and prints what
/// was reached. A part that is out ends with exit code 0, as `inspect` does.
void scan_until_decided(const Scan& plan,
                        const std::filesystem::path& inspection_plan,
                        RigDevices& devices,
                        const FolderLock& lock,
                        const CaptureOptions& options,
                        Terminal& terminal);

}  // namespace frangia
