#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "frangia/cad/cad_pmi.h"

namespace frangia {

/// A requirement as a line of printable characters, for the pipe between the processes; its fields
/// are separated by tabs. Faces beyond the first 30 are left out.
[[nodiscard]] std::string pmi_record(const CadRequirement& requirement);

/// Reads such a line.
///
/// @missing  none where it has another form, a number that is not finite, or a face beyond a
/// million
[[nodiscard]] std::optional<CadRequirement> parsed_pmi_record(std::string_view line);

}  // namespace frangia
