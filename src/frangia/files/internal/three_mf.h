#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads the meshes that the build items of a 3MF package refer to, with their transforms, also
/// where objects are in further files of the package (production extension, as slicers write).
///
/// @shape    triangles with base materials named "displaced" and "synthesized" get those marks
/// @units    converted to mm from the unit of the model
/// @missing  objects of every type are read as surfaces; textures, beams and slices are skipped
/// @errors   Error(Input) that names the file and the fault: not a zip archive, damaged, invalid
///          XML, XML with entities, an invalid number, an index out of range, an object that does
///          not exist or contains itself, an entry that expands to far more than a mesh, parts
///          that repeat beyond the allowed memory, an extension that the model requires and that is
///          not read; Error(Cancelled)
/// @source   3MF Consortium, 3D Manufacturing Format, Core Specification 1.3
[[nodiscard]] Mesh read_3mf(const std::filesystem::path& path,
                            const ReadOptions& options = {},
                            const Run& run = {});

/// Writes one object of type "model" and one build item; triangles of each mark have a base
/// material named "measured", "displaced" (yellow) or "synthesized" (blue).
///
/// The specification wants a "model" to be closed, and offers "surface" for others. PrusaSlicer 2.5
/// refuses a build item of type "surface" ("invalid object id") but loads and repairs an open
/// "model". So an open mesh is written as "model", with a warning through `run`.
///
/// @shape    triangles with two identical corners, which the format forbids, are omitted
/// @units    mm
/// @missing  normals, sigma and views are not stored
/// @errors   Error(Input) when check_mesh fails or the mesh has no triangle; Error(File) when the
///          file cannot be written
void write_3mf(const std::filesystem::path& path, const Mesh& mesh, const Run& run = {});

}  // namespace frangia
