#pragma once

#include "frangia/features/shape.h"
#include "frangia/inspection/inspection_plan.h"

namespace frangia {

/// How far a shape is from a planned feature: of its place and, where a diameter is stated, of its
/// size.
[[nodiscard]] double shape_mismatch_mm(const PlannedFeature& planned, const Shape& shape);

}  // namespace frangia
