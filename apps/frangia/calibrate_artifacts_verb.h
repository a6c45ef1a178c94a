#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/rig.h"

#include "terminal.h"

namespace frangia {

/// What `frangia calibrate rig` was asked for, when a scan holds a screen, plate or balls.
struct ArtifactVerbOptions {
  std::filesystem::path output;       ///< rig.toml to write
  std::filesystem::path report;       ///< page to write; empty: none
  std::optional<double> baseline_mm;  ///< distance of camera and projector, where it is known
  bool flat_screen = false;           ///< do not estimate the shape of the screen
};

/// Calibrates by artifacts, writes the rig and prints what was found. `start`: from a board.
void calibrate_by_artifacts(const std::vector<Scan>& scans,
                            const std::optional<Rig>& start,
                            const ArtifactVerbOptions& options,
                            Terminal& terminal);

}  // namespace frangia
