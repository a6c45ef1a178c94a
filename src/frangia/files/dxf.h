#pragma once

#include <filesystem>

#include "frangia/core/enum_names.h"
#include "frangia/core/run.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Entities that store the triangles of a DXF file.
enum class DxfVariant {
  Faces,     ///< one 3DFACE entity per triangle; nearly every program reads it
  Polyface,  ///< POLYLINE polyface meshes with shared vertices; smaller files
  Mesh       ///< MESH entities of release 2000; the smallest files, read by few programs
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(DxfVariant /*any*/) {
  return EnumNames<DxfVariant, 3>{{{DxfVariant::Faces, "faces"},
                                   {DxfVariant::Polyface, "polyface"},
                                   {DxfVariant::Mesh, "mesh"}}};
}

/// Options of `write_dxf`.
struct DxfOptions {
  DxfVariant variant = DxfVariant::Faces;  ///< entities that store the triangles
};

/// Writes a text DXF of release 12 (AC1009), or of release 2000 (AC1015) for DxfVariant::Mesh.
/// Measured triangles are on layer SCAN, displaced ones on SCAN_DISPLACED, synthesized ones on
/// SCAN_SYNTHESIZED.
///
/// @shape    a polyface mesh indexes its vertices with 16 bits, so a larger mesh is split spatially
///          into several
/// @units    mm, rounded to 0.0001; $INSUNITS and $MEASUREMENT state it, which release 12 does not
///          define but its readers accept
/// @missing  normals, sigma and views are not stored; a triangle with two corners that round to the
///          same coordinates is omitted
/// @errors   Error(Input) when check_mesh fails, when every triangle is degenerate after rounding,
///          or when a coordinate exceeds 1 000 km; Error(File) when the file cannot be written
/// @source   Autodesk, AutoCAD Release 12 Customization Manual, chapter 11; DXF Reference 2000
void write_dxf(const std::filesystem::path& path, const Mesh& mesh, const DxfOptions& options = {});

/// Reads the meshes of a text DXF: 3DFACE, POLYLINE as a polyface or M x N mesh, MESH without
/// subdivision, and blocks of them where they are inserted (INSERT).
///
/// @shape    corners with identical coordinates become one vertex; quadrilaterals become two
///          triangles; triangles on the layers that write_dxf names get their marks back
/// @units    converted to mm from the unit that $INSUNITS states; without it, mm
/// @missing  other entities are skipped, meshes of layers that are off or frozen and of paper space
///          left out; a warning through `run` lists them with their counts
/// @errors   Error(Input) that names the file and the line: no mesh, an invalid group, a vertex
///          index out of range, a coordinate that is not finite, a binary DXF, blocks that expand
///          beyond the memory of `options`; Error(Cancelled)
[[nodiscard]] Mesh read_dxf(const std::filesystem::path& path,
                            const Run& run = {},
                            const ReadOptions& options = {});

}  // namespace frangia
