#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Parses the value of an operation by the operation's pattern: words separated by commas. MM is a
/// length (parse_length_mm); DEG is an angle in degrees, with or without "deg"; N, PART and HOLE
/// are whole numbers that are not negative; any other word is a plain number.
///
/// units    lengths in mm, angles in degrees
/// errors   Error(Input) that shows the value and the pattern
[[nodiscard]] std::vector<double> edit_numbers(std::string_view pattern, const std::string& value);

/// The plane of N_X,N_Y,N_Z,MM: points p with n.p = mm, n made unit.
///
/// errors   Error(Input) when the normal has no length
[[nodiscard]] Eigen::Hyperplane<double, 3> edit_plane(const std::vector<double>& numbers);

/// errors   Error(Input) when it is none of measured, moved, invented
[[nodiscard]] Mark edit_mark(const std::string& value);

}  // namespace frangia
