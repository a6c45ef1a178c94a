#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "frangia/cad/cad_model.h"
#include "frangia/cad/nominal_face.h"
#include "frangia/features/geometric_tolerance.h"
#include "frangia/geometry/ray_scene.h"

#include "inspect_arguments.h"

namespace frangia {

/// What a mesh is measured against: a mesh, or a CAD model and its tessellation.
struct Reference {
  std::unique_ptr<CadModel> cad;  ///< null for a mesh
  RayScene scene;
};

/// Reads the reference; none where no one is named.
[[nodiscard]] std::optional<Reference> read_reference(const InspectArguments& arguments,
                                                      const Run& run);

/// Adds `reference` and a line about it, for a CAD model.
void add_reference(InspectAnswer& answer, const Reference& reference);

/// The face of each feature; empty for a reference that is a mesh.
[[nodiscard]] std::vector<std::optional<NominalFace>> nominal_faces(
    const Reference& reference, const std::vector<MeasuredFeature>& features);

}  // namespace frangia
