#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "frangia/calibrate/check/calibrate_check.h"
#include "frangia/core/run.h"

namespace frangia {

/// What a check of a rig found at one time.
struct DriftEntry {
  double time_s = 0.0;              ///< of the scan, since 1970, UTC
  std::string scan;                 ///< folder of the scan
  std::string kind;                 ///< of the artifact, or "part"
  std::vector<RigCheckItem> items;  ///< without `measured`
};

/// The log beside a rig: rig.toml has rig.drift.txt.
[[nodiscard]] std::filesystem::path drift_log_path(const std::filesystem::path& rig);

/// Reads a log, in the order of time. Damaged lines are passed over with a warning.
///
/// @missing  empty when there is no log yet
/// @errors   Error(File) when it cannot be read
[[nodiscard]] std::vector<DriftEntry> read_drift_log(const std::filesystem::path& log,
                                                     const Run& run = {});

/// Appends a check to a log, a line for each figure, unless the log has this scan already. Each
/// line is on the disk when the function returns.
///
/// @errors   Error(File) when the log cannot be written
void append_drift(const std::filesystem::path& log, const DriftEntry& entry);

/// "2026-11-27T11:16:10Z"
[[nodiscard]] std::string utc_text(double seconds_since_1970);

/// A picture of a log as SVG: each figure over time, with its standard uncertainty and its limits.
///
/// @missing  an empty text for an empty log
[[nodiscard]] std::string drift_plot(std::span<const DriftEntry> entries);

}  // namespace frangia
