#pragma once

#include <optional>
#include <string_view>

namespace frangia {

/// Reads a length from text such as "1mm", "0.5in" or "-25": a decimal number and a unit, which is
/// um, mm, cm, m or in. Spaces around the number and the unit are ignored.
///
/// @units    the result is in mm; a number without a unit is in mm
/// @errors   Error(Input) that shows the text: no number, an unknown unit, or a length that is not
///          finite. A negative length is a length; the caller checks the sign.
[[nodiscard]] double parse_length_mm(std::string_view text);

/// The length of a unit, in mm: the name of a unit (um, mm, cm, m, in, ft) or a length above 0 such
/// as "25.4mm"; none for another text.
[[nodiscard]] std::optional<double> parse_unit_mm(std::string_view text);

/// The units that `parse_unit_mm` accepts, for error messages.
inline constexpr std::string_view kUnitsKnown = "um, mm, cm, m, in, ft or a length such as 25.4mm";

}  // namespace frangia
