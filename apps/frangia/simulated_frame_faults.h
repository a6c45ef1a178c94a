#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {

/// Faults of single frames of a simulated scan, as VIEW:PATTERN:FRAME, each counted from 0.
struct SimulatedFrameFaults {
  std::vector<std::string> lost;      ///< black: the camera was out of step
  std::vector<std::string> repeated;  ///< the frame before was captured again
  std::vector<std::string> lamps_on;  ///< as VIEW:FRAME, frames counted over all patterns
  bool video_levels = false;          ///< counts of 16 to 235 of 255, cut off there
};

/// Adds the options of the faults to the verb.
void add_frame_faults(CLI::App& verb, SimulatedFrameFaults& faults);

/// Refuses faults that a planned scan cannot have.
///
/// @errors   Error(Input) for a view, pattern or frame that the scan does not have
void check_frame_faults(const SimulatedFrameFaults& faults, const Scan& plan);

/// The lamps that are switched on, for the renderer.
///
/// @errors   Error(Input) for a view or frame that the scan does not have
[[nodiscard]] std::vector<LampSwitch> lamps_of(const SimulatedFrameFaults& faults,
                                               const Scan& plan);

/// Changes the frames of a scan that was written.
///
/// @errors   Error(Input) for a view, pattern or frame that the scan does not have
void apply_frame_faults(const SimulatedFrameFaults& faults, const Scan& scan, const Run& run);

}  // namespace frangia
