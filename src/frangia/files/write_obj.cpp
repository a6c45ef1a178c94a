#include <string_view>

#include "frangia/files/check_mesh.h"
#include "frangia/files/file_writer.h"
#include "frangia/files/obj.h"

namespace frangia {
namespace {

void write_vector(FileWriter& file, std::string_view keyword, const Eigen::Vector3f& vector) {
  file.text(keyword);
  for (const float coordinate : vector) {
    file.text(" ");
    file.number(coordinate);
  }
  file.text("\n");
}

}  // namespace

void write_obj(const std::filesystem::path& path, const Mesh& mesh) {
  check_mesh(mesh, path);
  FileWriter file(path);
  file.text("# Frangia; lengths in mm\n");
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    write_vector(file, "v", vertex);
  for (const Eigen::Vector3f& normal : mesh.normals)
    write_vector(file, "vn", normal);
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    file.text("f");
    for (const std::size_t corner : triangle) {
      file.text(" ");
      file.number(corner + 1);
      if (mesh.normals.empty()) continue;
      file.text("//");
      file.number(corner + 1);
    }
    file.text("\n");
  }
  file.commit();
}

}  // namespace frangia
