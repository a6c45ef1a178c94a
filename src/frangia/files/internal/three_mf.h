#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A 3MF package: the meshes that its build names, each where its transforms put it.
///
/// shape    marks of triangles come back from base materials named "displaced" and "synthesized"
/// units    turned into mm from the unit that the model states
/// missing  supports and solids alike are surface here; textures, beams, slices and models in
///          further files are left out; `run` is warned of further files
/// errors   Error(Input) that names the file and what is wrong with it: no zip, damaged, XML that
///          is none or declares entities, a number that is none, a vertex or an object that is not
///          there, an object that is part of itself; one that unpacks to far too much
/// source   3MF Consortium, 3D Manufacturing Format, Core Specification 1.3
[[nodiscard]] Mesh read_3mf(const std::filesystem::path& path, const Run& run = {});

/// One object of type "model" and one item that builds it; triangles of each mark in a base
/// material named "measured", "displaced" (yellow) or "synthesized" (red).
///
/// shape    triangles with two corners alike, which the format forbids, are left out; as an open or
///          non-manifold mesh is no solid, such a one is written as type "surface"
/// units    mm
/// missing  normals, sigma_mm and views have no place
/// errors   Error(Input) when the mesh is not whole or has no triangle; Error(File) when it cannot
///          be written
void write_3mf(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
