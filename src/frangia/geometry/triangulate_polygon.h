#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace frangia {

using Polygon = std::vector<Eigen::Vector2d>;

/// Cuts a polygon with holes into triangles that use its own points only.
///
/// The outer line runs counter-clockwise, holes clockwise. Collinear points keep their place: each
/// becomes the corner of a triangle, so that a neighbour across the line fits.
/// shape    triples of indices into outer, then the holes, one after the other
/// errors   Error(Numeric) when the lines cross or run the wrong way round
/// source   ear clipping, holes joined by bridges: Eberly, Triangulation by Ear Clipping
[[nodiscard]] std::vector<std::array<std::size_t, 3>> triangulate_polygon(
    const Polygon& outer, const std::vector<Polygon>& holes = {});

}  // namespace frangia
