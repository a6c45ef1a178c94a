#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// The vertices of a closed polygon in order.
using Polygon = std::vector<Eigen::Vector2d>;

/// Triangulates a polygon with holes without additional points.
///
/// The outer polygon runs counter-clockwise, holes run clockwise. Collinear points become corners
/// of triangles, too, so that a neighbour across the edge fits without T-junctions. shape triples
/// of indices into `outer` followed by all holes errors   Error(Input) for fewer than three points;
/// Error(Numeric) when polygons intersect or have
///          the wrong orientation
/// @source   Eberly, Triangulation by Ear Clipping
[[nodiscard]] std::vector<std::array<std::size_t, 3>> triangulate_polygon(
    const Polygon& outer, const std::vector<Polygon>& holes = {});

}  // namespace frangia
