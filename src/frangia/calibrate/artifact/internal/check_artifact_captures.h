#pragma once

#include <span>

#include "frangia/calibrate/artifact/solve_artifacts.h"

namespace frangia {

/// @errors   Error(Input) as `solve_artifacts`, before anything is solved
void check_artifact_captures(std::span<const ArtifactCapture> captures, const Rig& start);

}  // namespace frangia
