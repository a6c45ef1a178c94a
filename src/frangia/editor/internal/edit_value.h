#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Parses the value of an operation by the operation's pattern: words separated by commas.
///
/// MM is a length (parse_length_mm), SIZE a length greater than 0, TOLERANCE a length of at least
/// 0. DEG is a positive angle in degrees, with or without "deg". N is a positive whole number,
/// COMPONENT and HOLE are whole numbers of at least 0, K and PER_MM are numbers of at least 0. Any
/// other word is a plain number.
///
/// @units    lengths in mm, angles in degrees
/// @errors   Error(Input) that shows the value and the pattern
[[nodiscard]] std::vector<double> edit_numbers(std::string_view pattern, const std::string& value);

/// The plane of the pattern X,Y,Z,MM: the points p with n.p = mm, where n is the unit normal along
/// X,Y,Z.
///
/// @errors   Error(Input) for a normal of length 0
[[nodiscard]] Eigen::Hyperplane<double, 3> edit_plane(const std::vector<double>& numbers);

/// Pattern of the values that `edit_outline` reads.
inline constexpr const char* kOutlinePattern = "X,Y,Z,X,Y,Z,...";

/// Reads an outline: the eye and at least three corners, three coordinates each.
///
/// @units    mm
/// @errors   Error(Input) that says how to write one; a value has at most 4096 corners
[[nodiscard]] ViewedOutline edit_outline(const std::string& value);

/// @errors   Error(Input) unless the value is measured, displaced or synthesized
[[nodiscard]] Mark edit_mark(const std::string& value);

}  // namespace frangia
