#pragma once

#include <filesystem>

#include "frangia/surface/mesh.h"

namespace frangia {

enum class DxfVariant {
  Faces,    ///< a 3DFACE for each triangle: understood by nearly everything
  Polyface  ///< POLYLINE polyface meshes that share their vertices: smaller
};

struct DxfOptions {
  DxfVariant variant = DxfVariant::Faces;
};

/// A DXF of release 12 (AC1009), the mesh on layer SCAN.
///
/// shape    a polyface mesh counts with 16 bits: a larger mesh is split by place into several
/// units    mm to 0.0001; $INSUNITS and $MEASUREMENT say so, which release 12 does not know but its
///          readers accept
/// missing  normals, sigma and views have no place; a triangle of which two corners are written
///          alike is left out
/// errors   Error(Input) when the mesh is not whole, has no triangle of any size, or lies farther
///          than 1 000 km away; Error(File) when it cannot be written
/// source   Autodesk, AutoCAD Release 12 Customization Manual, chapter 11
void write_dxf(const std::filesystem::path& path, const Mesh& mesh, const DxfOptions& options = {});

}  // namespace frangia
