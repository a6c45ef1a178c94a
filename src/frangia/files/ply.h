#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a PLY file: ascii, or binary in either byte order. A file without faces gives a mesh
/// without triangles.
///
/// @shape    the properties read are x y z; nx ny nz when all three exist; sigma_mm, and
///          its parts sigma_noise_mm and sigma_systematic_mm when both exist; views (ushort); mark
///          (uchar, of vertices and faces: 0 measured, 1 displaced, 2 synthesized); red green blue
///          (uchar, or ushort, or float from 0 to 1; also diffuse_red and so on). Polygons become
///          triangles. Other properties and elements are skipped.
/// @units    as in the file, assumed to be mm
/// @missing  a normal that is not finite becomes zero
/// @errors   Error(Input) that names the file and the fault: truncated, a count larger than the
///          file can hold, a face with fewer than three corners, a vertex index out of range, a
///          coordinate that is not finite, triangle strips
/// @source   Greg Turk, The PLY Polygon File Format, 1994
[[nodiscard]] Mesh read_ply(const std::filesystem::path& path, const Run& run = {});

/// A number for each vertex, beside those of a mesh.
struct VertexProperty {
  std::string name;           ///< of the property: "deviation_mm"
  std::vector<float> values;  ///< one for each vertex
};

/// Writes a binary little-endian PLY: x y z, then nx ny nz, sigma_mm, sigma_noise_mm and
/// sigma_systematic_mm where the mesh has them (all float), views (ushort), mark (uchar), red green
/// blue (uchar), the other properties (float); faces, with their mark where the mesh has it.
///
/// @units    mm
/// @errors   Error(Input) when check_mesh fails or a property has not one value for each vertex;
///           Error(File) when the file cannot be written
void write_ply(const std::filesystem::path& path,
               const Mesh& mesh,
               std::span<const VertexProperty> more);
/// The same without other properties.
void write_ply(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
