#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/durable_file.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Returns the text of a rig.toml from which `read_rig` restores the same rig. Values that are NaN
/// are left out.
[[nodiscard]] std::string rig_text(const Rig& rig);

/// Returns the text of a rig.toml with the response and the waveforms of a projector in place of
/// its own. All other tables, keys and comments stay as they are.
[[nodiscard]] std::string with_response(const std::string& rig_toml, const Projector& projector);

/// Returns the text of a rig.toml with another turntable; everything else stays as it is, to the
/// last digit.
[[nodiscard]] std::string with_turntable(const std::string& rig_toml, const Turntable& table);

/// Writes `rig_text` to a file, and the covariance of the parameters, where it is known, to the CSV
/// file that the calibration names, in the same folder; a file without a name is
/// NAME-covariance.csv for NAME.toml. The `[devices]` tables of the rig.toml
/// `devices_from` are copied, if it is given.
///
/// @errors   Error(File) when the file cannot be written; Error(Input) when `devices_from` cannot
///          be read
void write_rig(const std::filesystem::path& path,
               const Rig& rig,
               Durability durability = Durability::Buffered,
               const std::filesystem::path& devices_from = {});

}  // namespace frangia
