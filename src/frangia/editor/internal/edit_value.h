#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The numbers of an operation's value by its pattern: words parted by commas, of which MM and DEG
/// may carry their unit ("10mm"), N and PART and HOLE are whole and not negative, and the rest are
/// any numbers. Degrees stay degrees.
///
/// errors   Error(Input) that shows the value and the pattern
[[nodiscard]] std::vector<double> edit_numbers(std::string_view pattern, const std::string& value);

/// The plane of N_X,N_Y,N_Z,MM: points p with n.p = mm, n made unit.
///
/// errors   Error(Input) when the normal has no length
[[nodiscard]] Eigen::Hyperplane<double, 3> edit_plane(const std::vector<double>& numbers);

/// errors   Error(Input) when it is none of measured, moved, invented
[[nodiscard]] Mark edit_mark(const std::string& value);

}  // namespace frangia
