#pragma once

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {

/// A rig of which nothing is known.
[[nodiscard]] Rig unknown_rig();

/// Makes an unknown projector angular if the patterns of scan.toml give their fringes per degree.
void choose_projector_model(TomlReader& scan_toml, Projector& projector);

/// Takes the camera's size and white level from the first frame of the first view.
///
/// @errors   as reading a frame
void take_camera_from_frames(Scan& scan, const Run& run);

/// Gives a projector of unknown size the field over which the patterns in each direction do not
/// repeat: the range of the Gray code, or the least common multiple of the periods.
void assume_field(Scan& scan, const Run& run);

}  // namespace frangia
