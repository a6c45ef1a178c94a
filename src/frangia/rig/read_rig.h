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
/// @missing  NaN for a value that may be missing; a missing projector has a size of 0
/// @errors   Error(Input) that names the file and the key when a key is missing, of the wrong type
///          or not finite, when the projector model is unknown, or when a matrix is not a rotation
[[nodiscard]] Rig read_rig(const std::filesystem::path& path,
                           const Run& run = {},
                           RigContent content = RigContent::Complete);

/// Returns the text of a rig.toml from which `read_rig` restores the same rig. Values that are NaN
/// are left out.
[[nodiscard]] std::string rig_text(const Rig& rig);

/// Writes `rig_text` to a file. The `[devices]` tables of the rig.toml `devices_from` are copied,
/// if it is given.
///
/// @errors   Error(File) when the file cannot be written; Error(Input) when `devices_from` cannot
///          be read
void write_rig(const std::filesystem::path& path,
               const Rig& rig,
               Durability durability = Durability::Buffered,
               const std::filesystem::path& devices_from = {});

}  // namespace frangia
