#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "frangia/cad/read_cad.h"
#include "frangia/core/run.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// What a part is measured against: a mesh, or a CAD model and its tessellation.
struct InspectionReference {
  std::filesystem::path file;     ///< for messages; empty: none
  std::unique_ptr<CadModel> cad;  ///< null for a mesh
  RayScene scene;                 ///< of the mesh or the tessellation
};

/// How a reference is read.
struct ReferenceOptions {
  std::optional<double> unit_mm;                    ///< of its file; none: as it states, or mm
  ReadOptions read;                                 ///< memory that it may take
  double allow_time_s = CadOptions{}.allow_time_s;  ///< for reading a CAD file
};

/// Reads a mesh or a CAD file (`is_cad_file`) as a reference.
///
/// @units    mm: a mesh is scaled by `unit_mm`
/// @errors   Error(Input) as read_surface and read_cad; Error(Cancelled)
[[nodiscard]] InspectionReference read_inspection_reference(const std::filesystem::path& path,
                                                            const ReferenceOptions& options = {},
                                                            const Run& run = {});

/// A mesh as a reference.
///
/// @errors   Error(Input) for a mesh without triangles; Error(Cancelled)
[[nodiscard]] InspectionReference reference_of_mesh(Mesh mesh, const Run& run = {});

}  // namespace frangia
