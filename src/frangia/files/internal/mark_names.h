#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Names of the marks in OBJ groups and in glTF and 3MF materials, indexed by Mark.
inline constexpr std::array<std::string_view, 3> kMarkNames{"measured", "displaced", "synthesized"};

/// The mark of a group or material; Mark::Measured for a name that another program chose.
[[nodiscard]] inline Mark mark_of_name(std::string_view name) {
  const auto* const found = std::find(kMarkNames.begin(), kMarkNames.end(), name);
  return found == kMarkNames.end() ? Mark::Measured : static_cast<Mark>(found - kMarkNames.begin());
}

}  // namespace frangia
