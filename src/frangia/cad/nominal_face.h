#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "frangia/cad/cad_model.h"
#include "frangia/core/run.h"
#include "frangia/features/geometric_tolerance.h"

namespace frangia {

/// The face that a feature was made by.
struct NominalFace {
  std::uint32_t number = 0;  ///< of the face, from 1
  Shape shape;               ///< as the model states it
};

/// Finds the face of a model that a feature of an aligned mesh was made by: the one of its kind to
/// which most of its points are nearest.
///
/// `scene` is of `model.mesh()`.
/// @missing       none where no face of that kind is nearest to a quarter of the points, as for
///                lines and circles
[[nodiscard]] std::optional<NominalFace> nominal_face(const CadModel& model,
                                                      const RayScene& scene,
                                                      const MeasuredFeature& feature);

}  // namespace frangia
