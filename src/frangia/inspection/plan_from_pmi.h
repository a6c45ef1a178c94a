#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "frangia/cad/cad_model.h"
#include "frangia/inspection/inspection_plan.h"

namespace frangia {

/// A plan that was made of the product and manufacturing information of a model.
struct PmiPlan {
  InspectionPlan plan;                ///< its reference is the model's file
  std::vector<std::string> left_out;  ///< what is not in the plan, and why: a clause each
};

/// Makes a plan of inspection of the semantic PMI of a CAD model with these faces: diameters,
/// distances, angles, forms, orientations, positions and run-outs with their datums, and the
/// profile of the whole surface. Features are the faces of the model. The most complete system of
/// datums aligns the part, else its best fit.
///
/// `file` is that of the model, for messages and as the reference of the plan.
/// @units    mm, degrees
/// @errors   Error(Input) that names the file, when nothing of it can be planned: its protocol is
///           AP203 or AP214, its tolerances are only drawn, or it states none
/// @source   ISO 10303-242
[[nodiscard]] PmiPlan plan_from_pmi(std::span<const CadFace> faces,
                                    const CadPmi& pmi,
                                    const std::filesystem::path& file);

}  // namespace frangia
