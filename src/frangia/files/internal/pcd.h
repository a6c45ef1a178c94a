#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a point cloud of the Point Cloud Library, ascii or binary.
///
/// @shape    points without triangles; the fields read are x y z, normal_x normal_y normal_z when
///          all three exist, rgb or rgba, or r g b, and sigma_mm with its parts sigma_noise_mm and
///          sigma_systematic_mm; `run` gets a VIEWPOINT, which is not applied
/// @units    as in the file, assumed to be mm
/// @missing  points that are not finite, which an organized cloud has at unmeasured pixels, are
///          omitted; `run` gets their number
/// @errors   Error(Input) that names the file and the fault: no x y z, counts larger than the file
///          can hold, truncated, compressed data
/// @source   PCL, The PCD file format 0.7
[[nodiscard]] Mesh read_pcd(const std::filesystem::path& path, const Run& run = {});

/// Writes a binary cloud: x y z, then normals, sigma_mm and its parts where the mesh has them (all
/// float), views and mark as unsigned integers.
///
/// @units    mm
/// @missing  triangles are not stored
/// @errors   Error(Input) when check_mesh fails; Error(File) when the file cannot be written
void write_pcd(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
