#pragma once

#include <filesystem>

#include "frangia/inspection/inspect_part.h"

#include "inspect_arguments.h"

namespace frangia {

/// Checks before the work that the mesh of a file has what --show names.
void check_shown(const InspectArguments& arguments,
                 const InspectionPlan& plan,
                 const std::filesystem::path& path,
                 const Mesh& mesh);

/// Draws the picture that the arguments ask for.
void draw_picture(const InspectArguments& arguments, const Inspection& part, const Run& run);

}  // namespace frangia
