#pragma once

#include <functional>
#include <vector>

#include "frangia/features/geometric_tolerance.h"
#include "frangia/features/shape.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspection/inspection_plan.h"

namespace frangia::inspection {

/// What was found of a feature of a plan.
struct AssignedFeature {
  const MeasuredFeature* measured = nullptr;   ///< null: not found
  const PlannedFeature* claimed_by = nullptr;  ///< whose feature the nearest one is; may be null
  double off_mm = 0.0;                         ///< of the place of `measured` from the planned
                                               ///< one, where that does not lie on it; or 0
};

/// Whether a shape is one that a plan names: of its kind, with its place and its diameter within
/// 1 % of the diagonal of the part.
[[nodiscard]] std::function<bool(const Shape&)> planned_shapes(std::vector<PlannedFeature> planned,
                                                               const Mesh& mesh);

/// The measured feature of each planned one: that of its kind whose place and diameter come
/// nearest, within `farthest_mm`.
///
/// A measured feature belongs to the planned one that it is nearest to. Another one shares it only
/// if its own place lies on it and its diameter is that of it, within a tenth of `farthest_mm`:
/// otherwise a hole that is missing would have the size of its neighbor.
/// @shape    in the order of `planned`
[[nodiscard]] std::vector<AssignedFeature> assign_features(
    const std::vector<PlannedFeature>& planned,
    const std::vector<MeasuredFeature>& measured,
    double farthest_mm);

}  // namespace frangia::inspection
