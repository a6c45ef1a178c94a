#pragma once

#include <filesystem>

#include "frangia/core/enum_names.h"
#include "frangia/core/run.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// How much a rig.toml must hold.
enum class RigContent {
  Complete,     ///< a calibrated rig
  StartValues,  ///< what is known before calibration: sizes and the projector's model
  PhaseOnly     ///< what decoding needs: the camera's size; the projector may be missing
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(RigContent /*any*/) {
  return EnumNames<RigContent, 3>{{{RigContent::Complete, "complete"},
                                   {RigContent::StartValues, "start-values"},
                                   {RigContent::PhaseOnly, "phase-only"}}};
}

/// Reads a rig.toml; docs/scan-format.md describes the format. An unknown key is a warning that
/// names it. With `RigContent::StartValues` focal lengths, principal points and the projector's
/// pose may be missing; with `RigContent::PhaseOnly` the whole projector, too.
///
/// A projector of model "label" needs its size alone, and a second camera.
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

}  // namespace frangia
