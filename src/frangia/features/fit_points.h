#pragma once

#include <cstdint>
#include <span>

#include "frangia/core/run.h"
#include "frangia/features/feature_points.h"
#include "frangia/features/find_features.h"
#include "frangia/features/shape.h"

namespace frangia {

/// Fits a plane, a cylinder or a sphere to points that someone chose, such as a selection of
/// triangles. Points farther than five times the median residual of a first fit are ignored.
///
/// @units    mm
/// @errors   Error(Input) for another kind, for fewer than twice as many points as the shape has
///           parameters, or when the points do not determine the shape; Error(Cancelled)
[[nodiscard]] Feature fit_points(const FeaturePoints& points,
                                 std::span<const std::uint32_t> chosen,
                                 ShapeKind kind,
                                 const Run& run = {});

}  // namespace frangia
