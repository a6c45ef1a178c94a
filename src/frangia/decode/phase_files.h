#pragma once

#include <cstddef>
#include <filesystem>

#include "frangia/core/enum_names.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/own_stages.h"

namespace frangia {

/// What phase maps of another program hold.
enum class PhaseKind {
  Wrapped,  ///< modulo 2 pi, one map for each fringe pattern
  Absolute  ///< relative to the projector, of the finest fringes of a direction
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(PhaseKind /*any*/) {
  return EnumNames<PhaseKind, 2>{
      {{PhaseKind::Wrapped, "wrapped"}, {PhaseKind::Absolute, "absolute"}}};
}

/// Phase maps of another program that replace the decoding of frames.
struct PhaseFiles {
  std::filesystem::path folder;          ///< of FOLDER/000/PATTERN-phase.tiff
  PhaseKind kind = PhaseKind::Absolute;  ///< what the maps hold
};

/// Stages that take the phase of one view from files: FOLDER/VIEW/PATTERN-phase.tiff and
/// PATTERN-sigma.tiff, or .npy, of 32-bit floating point. VIEW counts from 000 in the order of
/// scan.toml; PATTERN is the name of a fringe pattern.
///
/// Gray code, the laser sheet and colors still come from the frames, which the scan must hold.
///
/// @units    rad
/// @missing  NaN in either file
/// @errors   Error(Input), when the stages run, that names the file: missing, of another size or
///           type, or with a sigma that is not above 0
[[nodiscard]] OwnStages stages_from_files(const PhaseFiles& files, std::size_t view);

/// Refuses a folder without a map of the first view, before any work.
///
/// @errors   Error(Input) that names the missing file
void check_phase_files(const PhaseFiles& files, const Scan& scan);

}  // namespace frangia
