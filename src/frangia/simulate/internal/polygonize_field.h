#pragma once

#include <functional>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A solid as a function of place: negative inside, about the distance in mm near the surface.
using Field = std::function<double(const Eigen::Vector3d&)>;

/// The closed surface where a field is zero, in triangles about as large as a cell.
///
/// Every cell that the surface passes gets one vertex, moved onto the zero by Newton's method.
/// @units    mm
/// @errors   Error(Input) when the solid reaches the border of the box; Error(Cancelled)
/// @source   surface nets, Gibson 1998
[[nodiscard]] Mesh polygonize_field(const Field& field,
                                    const Eigen::AlignedBox3d& box_mm,
                                    double cell_mm,
                                    const Run& run = {});

}  // namespace frangia
