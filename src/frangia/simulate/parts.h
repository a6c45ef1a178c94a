#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Names of the built-in parts.
[[nodiscard]] std::vector<std::string> part_names();

/// Makes a built-in part: a closed mesh with outward normals that stands on z = 0 around the z
/// axis.
///
/// shaft     turned in steps, with a milled keyway
/// blade     turbine blade, twisted, on a fir-tree root
/// bust      a head on shoulders and a round socle: smooth, with undercuts
/// ball-bar  two spheres of radius 20 at (0, -35, 60) and (0, 35, 60) on posts and a base
/// plate     80 x 60 x 6, standing upright on the axis
/// bracket   an angle with a rib, bores and an overhang
/// groove    a block 35 x 64 x 50 with an upright 90 degree V-groove, 25 deep, in its face x = 15
/// gear      a spur gear of 14 teeth of module 4, with a hub, and a bore with a keyway
///
/// @units    mm, object frame; round faces have chord errors below 0.002 mm
/// @errors   Error(Input) that lists the names for an unknown name
[[nodiscard]] Mesh make_part(std::string_view name, const Run& run = {});

[[nodiscard]] Mesh make_shaft();  ///< the part "shaft" of `make_part`
[[nodiscard]] Mesh make_blade();  ///< the part "blade" of `make_part`
/// The part "bust" of `make_part`, the only one that is slow enough to be cancelled.
[[nodiscard]] Mesh make_bust(const Run& run = {});
[[nodiscard]] Mesh make_ball_bar();  ///< the part "ball-bar" of `make_part`
[[nodiscard]] Mesh make_plate();     ///< the part "plate" of `make_part`
[[nodiscard]] Mesh make_bracket();   ///< the part "bracket" of `make_part`
[[nodiscard]] Mesh make_groove();    ///< the part "groove" of `make_part`
[[nodiscard]] Mesh make_gear();      ///< the part "gear" of `make_part`

/// A ball bar for acceptance tests: balls along z, on a thin rod, with the middle of their centers
/// at the origin; or one ball, with its center there, on a stem below it.
///
/// @units    mm
/// @errors   Error(Input) for another number of balls
[[nodiscard]] Mesh make_dumbbell(const std::vector<double>& diameters_mm, double spacing_mm);

}  // namespace frangia
