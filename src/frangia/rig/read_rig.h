#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/durability.h"
#include "frangia/core/run.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// How much a rig.toml must hold.
enum class RigContent {
  Complete,     ///< a calibrated rig
  StartValues,  ///< what is known before calibration: sizes and the projector's model
  PhaseOnly     ///< what decoding needs: the camera's size; the projector may be missing
};

/// Reads a rig.toml; docs/scan-format.md describes the format. An unknown key is a warning that
/// names it. With `RigContent::StartValues` focal lengths, principal points and the projector's
/// pose may be missing; with `RigContent::PhaseOnly` the whole projector, too.
///
/// The covariance of the parameters is read from the CSV file that `[calibration]` names, except
/// with `RigContent::StartValues`.
///
/// @missing  NaN for a value that may be missing; a missing projector has a size of 0
/// @errors   Error(Input) that names the file and the key when a key is missing, of the wrong type
///          or not finite, when the projector model is unknown, when a matrix is not a rotation,
///          or as `read_rig_covariance`
[[nodiscard]] Rig read_rig(const std::filesystem::path& path,
                           const Run& run = {},
                           RigContent content = RigContent::Complete);

/// Returns the text of a rig.toml from which `read_rig` restores the same rig. Values that are NaN
/// are left out.
[[nodiscard]] std::string rig_text(const Rig& rig);

/// Returns the text of a rig.toml with the response and the waveforms of a projector in place of
/// its own. All other tables, keys and comments stay as they are.
[[nodiscard]] std::string with_response(const std::string& rig_toml, const Projector& projector);

/// Writes `rig_text` to a file, and the covariance of the parameters, where it is known, to the CSV
/// file beside it. The `[devices]` tables of the rig.toml `devices_from` are copied,
/// if it is given.
///
/// @errors   Error(File) when the file cannot be written; Error(Input) when `devices_from` cannot
///          be read
void write_rig(const std::filesystem::path& path,
               const Rig& rig,
               Durability durability = Durability::Buffered,
               const std::filesystem::path& devices_from = {});

}  // namespace frangia
