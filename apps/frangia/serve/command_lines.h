#pragma once

#include "frangia/service/service.h"

namespace frangia {

/// The command lines of this program that do the same as the app did in a project, by the names
/// "scan", "reconstruct" and "edit"; those that do not apply are left out.
[[nodiscard]] CommandLines command_lines(const ProjectProgress& project);

}  // namespace frangia
