#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The built-in parts, in the order a person meets them.
[[nodiscard]] std::vector<std::string> part_names();

/// A part by its name: closed, outward, standing on z = 0 about the z axis, tens of mm in size.
///
/// shaft     turned in steps, with a milled keyway
/// blade     of a turbine: twisted, on a fir-tree root
/// bust      a head on shoulders and a round socle: smooth, with undercuts
/// ball-bar  two spheres of radius 20 at (0, -35, 60) and (0, 35, 60) on posts and a base
/// plate     80 x 60 x 6, standing upright on the axis
/// bracket   an angle with a rib, bores and an overhang
///
/// units    mm, object frame; round faces are off by less than 0.002 mm
/// errors   Error(Input) that lists the names when there is no such part
[[nodiscard]] Mesh make_part(std::string_view name);

[[nodiscard]] Mesh make_shaft();
[[nodiscard]] Mesh make_blade();
[[nodiscard]] Mesh make_bust();
[[nodiscard]] Mesh make_ball_bar();
[[nodiscard]] Mesh make_plate();
[[nodiscard]] Mesh make_bracket();

}  // namespace frangia
