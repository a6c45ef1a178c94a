#pragma once

#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Takes the covariance of the start as a prior. That of the pose of an angular projector is left
/// out: it is estimated again.
void set_artifact_prior(const Rig& start, ArtifactProblem& problem);

}  // namespace frangia
