#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A cloud of the Point Cloud Library, ascii or binary.
///
/// shape    points without triangles. Kept: x y z, normal_x normal_y normal_z when all are there,
///          sigma_mm; other fields are skipped
/// units    as in the file, taken for mm
/// missing  points that are not finite, which an organised cloud has where nothing was seen, are
///          left out; `run` is told how many
/// errors   Error(Input) that names the file and what is wrong: no x y z, counts that the file has
///          no room for, cut short, the compressed form
/// source   PCL, The PCD file format 0.7
[[nodiscard]] Mesh read_pcd(const std::filesystem::path& path, const Run& run = {});

/// Binary: x y z, normals and sigma_mm when the mesh has them, all float; views and mark as
/// unsigned integers.
///
/// units    mm
/// missing  triangles have no place
/// errors   Error(Input) when the mesh is not whole; Error(File) when it cannot be written
void write_pcd(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
