#include <cstdint>
#include <string>

#include <Eigen/Geometry>

#include "frangia/files/check_mesh.h"
#include "frangia/files/file_writer.h"
#include "frangia/files/stl.h"

namespace frangia {

void write_stl(const std::filesystem::path& path, const Mesh& mesh) {
  check_triangles(mesh, path);
  FileWriter file(path);
  std::string header = "Frangia; binary STL; lengths in mm";  // "solid" here would look like ascii
  header.resize(80, ' ');
  file.text(header);
  file.binary(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3f& a = mesh.vertices_mm[triangle[0]];
    const Eigen::Vector3f& b = mesh.vertices_mm[triangle[1]];
    const Eigen::Vector3f& c = mesh.vertices_mm[triangle[2]];
    const Eigen::Vector3f normal = (b - a).cross(c - a).stableNormalized();
    for (const float coordinate : normal)
      file.binary(coordinate);
    for (const std::uint32_t corner : triangle) {
      for (const float coordinate : mesh.vertices_mm[corner])
        file.binary(coordinate);
    }
    file.binary(std::uint16_t{0});
  }
  file.commit();
}

}  // namespace frangia
