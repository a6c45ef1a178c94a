#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

enum class DxfVariant {
  Faces,     ///< a 3DFACE for each triangle: understood by nearly everything
  Polyface,  ///< POLYLINE polyface meshes that share their vertices: smaller
  Mesh       ///< MESH entities of release 2000: smallest, few readers
};

struct DxfOptions {
  DxfVariant variant = DxfVariant::Faces;
};

/// A DXF of release 12 (AC1009), or 2000 (AC1015) for MESH: what was measured on layer SCAN, what
/// was moved beyond its sigma on SCAN_DISPLACED, what was invented on SCAN_SYNTHESIZED.
///
/// shape    a polyface mesh counts with 16 bits: a larger mesh is split by place into several
/// units    mm to 0.0001; $INSUNITS and $MEASUREMENT say so, which release 12 does not know but its
///          readers accept
/// missing  normals, sigma and views have no place; a triangle of which two corners are written
///          alike is left out
/// errors   Error(Input) when the mesh is not whole, has no triangle of any size, or lies farther
///          than 1 000 km away; Error(File) when it cannot be written
/// source   Autodesk, AutoCAD Release 12 Customization Manual, chapter 11; DXF Reference 2000
void write_dxf(const std::filesystem::path& path, const Mesh& mesh, const DxfOptions& options = {});

/// The meshes of a DXF (text): 3DFACE, POLYLINE as polyface or M x N mesh, MESH at its lowest
/// level.
///
/// shape    corners at the very same place become one vertex; faces of four corners become two
///          triangles. Marks come back from the layers that write_dxf names.
/// units    turned into mm where $INSUNITS says what they are; else taken for mm
/// missing  other entities, and all that stands in blocks, are left out: `run` is warned with their
///          names and how many
/// errors   Error(Input) that names the file and the line: no mesh in it, a group that is none, an
///          index of a vertex that is not there, a vertex that is not finite; a binary DXF
[[nodiscard]] Mesh read_dxf(const std::filesystem::path& path, const Run& run = {});

}  // namespace frangia
