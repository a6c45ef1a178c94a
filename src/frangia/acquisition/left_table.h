#pragma once

#include <filesystem>
#include <optional>

namespace frangia {

/// Where the last session of a capture left its turntable.
struct LeftTable {
  std::optional<double> angle_deg;  ///< empty: the session ended while the table turned
};

/// Reads from the log of a scan folder where its turntable was left. Empty without a capture, and
/// before its first move. A table without a home switch cannot find this angle again:
/// `CaptureOptions::table_at_rad` states it to the session that goes on.
///
/// @errors   Error(Input) when the log is not one
[[nodiscard]] std::optional<LeftTable> left_table(const std::filesystem::path& scan_folder);

}  // namespace frangia
