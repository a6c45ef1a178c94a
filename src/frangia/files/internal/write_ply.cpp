#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/write_vertices.h"
#include "frangia/files/ply.h"

namespace frangia {
namespace {

void write_ply_header(FileWriter& file, const Mesh& mesh, std::span<const VertexProperty> more) {
  file.text("ply\nformat binary_little_endian 1.0\ncomment Frangia; lengths in mm\n");
  file.text(fmt::format("element vertex {}\n", mesh.vertices_mm.size()));
  file.text("property float x\nproperty float y\nproperty float z\n");
  if (!mesh.normals.empty()) {
    file.text("property float nx\nproperty float ny\nproperty float nz\n");
  }
  if (!mesh.sigma_mm.empty()) file.text("property float sigma_mm\n");
  if (!mesh.sigma_noise_mm.empty()) file.text("property float sigma_noise_mm\n");
  if (!mesh.sigma_systematic_mm.empty()) file.text("property float sigma_systematic_mm\n");
  if (!mesh.views.empty()) file.text("property ushort views\n");
  if (!mesh.vertex_marks.empty()) file.text("property uchar mark\n");
  if (!mesh.colors.empty())
    file.text("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  for (const VertexProperty& property : more)
    file.text(fmt::format("property float {}\n", property.name));
  file.text(fmt::format("element face {}\n", mesh.triangles.size()));
  file.text("property list uchar int vertex_indices\n");
  if (!mesh.triangle_marks.empty()) file.text("property uchar mark\n");
  file.text("end_header\n");
}

}  // namespace

void write_ply(const std::filesystem::path& path,
               const Mesh& mesh,
               std::span<const VertexProperty> more) {
  check_mesh(mesh, path);
  for (const VertexProperty& property : more) {
    require(property.values.size() == mesh.vertices_mm.size(),
            "write_ply: a property needs one value for each vertex");
  }
  FileWriter file(path);
  write_ply_header(file, mesh, more);
  write_vertices(file, mesh, ColorLayout::Bytes, more);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    file.binary(std::uint8_t{3});
    for (const std::uint32_t corner : mesh.triangles[i])
      file.binary(corner);
    if (!mesh.triangle_marks.empty()) {
      file.binary(static_cast<std::uint8_t>(mesh.triangle_marks[i]));
    }
  }
  file.commit();
}

void write_ply(const std::filesystem::path& path, const Mesh& mesh) {
  write_ply(path, mesh, {});
}

}  // namespace frangia
