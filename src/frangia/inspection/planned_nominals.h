#pragma once

#include <filesystem>
#include <vector>

#include "frangia/cad/cad_model.h"
#include "frangia/inspection/inspection_plan.h"

namespace frangia {

/// Completes the features of a plan from the faces of its CAD reference: kind, place and diameter
/// of a feature that names its face; the diameter of one that states none, from the face of its
/// kind whose center, or axis, comes nearest.
///
/// `path` is that of the plan, for messages.
/// @units    mm
/// @errors   Error(Input) that names the plan and the feature, where its face does not exist or is
///           a free-form surface, or where a tolerance has no diameter to refer to
void state_nominals(std::vector<PlannedFeature>& features,
                    const std::vector<CadFace>& faces,
                    const std::filesystem::path& path);

/// Checks the features of a plan whose reference is no CAD model.
///
/// @errors   Error(Input) that names the plan and the feature which refers to a face, or whose
///           tolerance has no diameter to refer to
void check_without_cad(const std::vector<PlannedFeature>& features,
                       const std::filesystem::path& path);

}  // namespace frangia
