#pragma once

#include <string_view>

namespace frangia {

/// Reads a length from text such as "1mm", "0.5in" or "-25": a decimal number and a unit, which is
/// um, mm, cm, m or in. Spaces around the number and the unit are ignored.
///
/// @units    the result is in mm; a number without a unit is in mm
/// @errors   Error(Input) that shows the text: no number, an unknown unit, or a length that is not
///          finite. A negative length is a length; the caller checks the sign.
[[nodiscard]] double parse_length_mm(std::string_view text);

}  // namespace frangia
