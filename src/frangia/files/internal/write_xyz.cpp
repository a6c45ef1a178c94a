#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/xyz.h"

namespace frangia {
namespace {

void write_vector(FileWriter& file, const Eigen::Vector3f& v) {
  file.number(v.x());
  file.text(" ");
  file.number(v.y());
  file.text(" ");
  file.number(v.z());
}

}  // namespace

void write_xyz(const std::filesystem::path& path, const Mesh& mesh) {
  check_mesh(mesh, path);
  FileWriter file(path);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    write_vector(file, mesh.vertices_mm[i]);
    if (!mesh.normals.empty()) {
      file.text(" ");
      write_vector(file, mesh.normals[i]);
    }
    file.text("\n");
  }
  file.commit();
}

}  // namespace frangia
