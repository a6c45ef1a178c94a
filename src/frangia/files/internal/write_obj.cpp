#include <cstdint>

#include <fmt/format.h>

#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/obj.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

void write_vertex(FileWriter& file, const Mesh& mesh, std::size_t vertex) {
  file.text("v");
  for (const float coordinate : mesh.vertices_mm[vertex]) {
    file.text(" ");
    file.number(coordinate);
  }
  if (!mesh.colors.empty()) {
    for (const std::uint8_t channel : mesh.colors[vertex])
      file.text(fmt::format(" {:.4f}", channel / 255.0));
  }
  file.text("\n");
}

void write_face(FileWriter& file, const Mesh& mesh, std::size_t triangle) {
  file.text("f");
  for (const std::size_t corner : mesh.triangles[triangle]) {
    file.text(" ");
    file.number(corner + 1);
    if (mesh.normals.empty()) continue;
    file.text("//");
    file.number(corner + 1);
  }
  file.text("\n");
}

}  // namespace

void write_obj(const std::filesystem::path& path, const Mesh& mesh) {
  check_mesh(mesh, path);
  FileWriter file(path);
  file.text("# Frangia; lengths in mm\n");
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    write_vertex(file, mesh, i);
  for (const Eigen::Vector3f& normal : mesh.normals)
    file.line("vn", normal);
  const bool marked = !mesh.vertex_marks.empty() || !mesh.triangle_marks.empty();
  Mark group = Mark::Measured;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (marked && (i == 0 || mark_of(mesh, i) != group)) {
      group = mark_of(mesh, i);
      file.text("g ");
      file.text(name_of(group));
      file.text("\n");
    }
    write_face(file, mesh, i);
  }
  file.commit();
}

}  // namespace frangia
