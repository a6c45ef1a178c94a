#include <cstdint>
#include <string>
#include <string_view>

#include <Eigen/Geometry>

#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/stl.h"

namespace frangia {

namespace {

Eigen::Vector3f normal_of(const Mesh& mesh, const Mesh::Triangle& triangle) {
  const Eigen::Vector3f& a = mesh.vertices_mm[triangle[0]];
  const Eigen::Vector3f& b = mesh.vertices_mm[triangle[1]];
  const Eigen::Vector3f& c = mesh.vertices_mm[triangle[2]];
  return (b - a).cross(c - a).stableNormalized();
}

void write_binary(FileWriter& file, const Mesh& mesh) {
  std::string header = "Frangia; binary STL; lengths in mm";  // must not begin with "solid"
  header.resize(80, ' ');
  file.text(header);
  file.binary(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    for (const float coordinate : normal_of(mesh, triangle))
      file.binary(coordinate);
    for (const std::uint32_t corner : triangle) {
      for (const float coordinate : mesh.vertices_mm[corner])
        file.binary(coordinate);
    }
    file.binary(std::uint16_t{0});
  }
}

void write_ascii(FileWriter& file, const Mesh& mesh) {
  file.text("solid frangia\n");
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    file.line(" facet normal", normal_of(mesh, triangle));
    file.text("  outer loop\n");
    for (const std::uint32_t corner : triangle)
      file.line("   vertex", mesh.vertices_mm[corner]);
    file.text("  endloop\n endfacet\n");
  }
  file.text("endsolid frangia\n");
}

}  // namespace

void write_stl(const std::filesystem::path& path, const Mesh& mesh, const StlOptions& options) {
  check_triangles(mesh, path);
  FileWriter file(path);
  if (options.ascii) {
    write_ascii(file, mesh);
  } else {
    write_binary(file, mesh);
  }
  file.commit();
}

}  // namespace frangia
